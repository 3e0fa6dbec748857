// Readings of the X-ray as colours, figures and sentences.

import { text } from '../messages';
import type { Label } from './labels';
import { channels, colourOf, forceText, isDark, isLoose, NO_COLOUR, type Reading } from './readings';

/** Returns the colour of a block: red, green and blue in sRGB, 0 to 1. */
export function stainOf({ pull }: Reading): [number, number, number] {
  return pull === null ? channels(NO_COLOUR) : colourOf(pull);
}

/** Returns the figure on a block, null for a block without one. */
export function labelOf(reading: Reading): Label | null {
  const { pull } = reading;
  return pull === null ? null : { text: forceText(pull), dark: isDark(pull), marked: isLoose(reading) };
}

/** Describes a block by its reading. */
export function describe(body: number, { load, pull }: Reading): string {
  const { pull: pulls, noSupport, load: newtons, noLoad, block } = text.xray;
  const start = pull === null ? noSupport : pulls(forceText(pull));
  return block(body, start, load < 0.005 ? noLoad : newtons(forceText(load)));
}
