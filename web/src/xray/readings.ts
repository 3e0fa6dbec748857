// The X-ray: load and breakaway force of each block as numbers and colours.

import { Vector3 } from 'three';
import { decimal } from '../messages';
import type { Bodies } from '../view/bodies';

/**
 * Numbers per body: normal force on its upper face, force that starts it sliding (N; NaN without
 * support).
 */
export const XRAY_STRIDE = 2;
/** Breakaway force below which a block is loose, N: hardly more than that of its own weight. */
export const LOOSE = 0.1;
/** End of the colour scale, N. It is logarithmic and begins at [`LOOSE`]. */
export const END = 10;
/** Ticks of the legend, N. */
export const TICKS = [0.1, 0.3, 1, 3, 10];
/**
 * Sine of the inclination up to which a block lies: a pull along it then differs by at most a tenth
 * of its weight with the direction.
 */
const MAX_INCLINATION = 0.1;

/**
 * From loose to tight: the reverse of viridis, whose lightness falls evenly for any colour vision.
 */
const RAMP = [
  '#fde725',
  '#b5de2b',
  '#6ece58',
  '#35b779',
  '#1f9e89',
  '#26828e',
  '#31688e',
  '#3e4989',
  '#482878',
  '#440154',
];
/** Colour of blocks without a breakaway force. */
export const NO_COLOUR = '#8b857e';
/** Level from which a block is dark enough for light text. */
const DARK = 0.4;

/** Colours of the scale as a CSS gradient. */
export const GRADIENT = `linear-gradient(to right, ${RAMP.join(', ')})`;

/** Returns the level of a force (N) on the scale, 0 to 1. */
export function levelOf(force: number): number {
  return Math.min(1, Math.max(0, Math.log(force / LOOSE) / Math.log(END / LOOSE)));
}

/** Returns the colour for a breakaway force (N): red, green and blue in sRGB, 0 to 1. */
export function colourOf(force: number): [number, number, number] {
  const at = levelOf(force) * (RAMP.length - 1);
  const from = Math.min(RAMP.length - 2, Math.floor(at));
  const [a, b] = [RAMP[from], RAMP[from + 1]].map(channels);
  return [0, 1, 2].map(k => a[k] + (at - from) * (b[k] - a[k])) as [number, number, number];
}

/** Parses `#rrggbb` to three numbers from 0 to 1. */
export function channels(hex: string): [number, number, number] {
  return [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255) as [number, number, number];
}

/** Returns true if text on a block with a breakaway force (N) must be light. */
export function isDark(force: number): boolean {
  return levelOf(force) > DARK;
}

/** Formats a force, N: hundredths below one newton, tenths above. */
export function forceText(force: number): string {
  return decimal(force, force < 0.995 ? 2 : force < 9.95 ? 1 : 0);
}

export interface Reading {
  /** Normal force on the upper face, N. */
  load: number;
  /**
   * Force along the block that starts it sliding, N; null if it does not lie flat or has no
   * support.
   */
  pull: number | null;
}

/** Returns the reading of each block from the X-ray of a tower at rest. */
export function readings(xray: ArrayLike<number>, bodies: Bodies): Reading[] {
  return Array.from({ length: bodies.count }, (_, body) => {
    const [load, pull] = [xray[XRAY_STRIDE * body], xray[XRAY_STRIDE * body + 1]];
    return { load, pull: Number.isNaN(pull) || !isLevel(bodies, body) ? null : pull };
  });
}

export function isLoose({ pull }: Reading): boolean {
  return pull !== null && pull < LOOSE;
}

/** Returns true if a block lies on one of its faces with its long axis level. */
function isLevel(bodies: Bodies, body: number): boolean {
  const rotation = bodies.rotation(body, bodies.newest);
  const size = bodies.size(body);
  const heights = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map(axis =>
    Math.abs(axis.applyQuaternion(rotation).z),
  );
  const long = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : size.y >= size.z ? 1 : 2;
  return (
    heights[long] < MAX_INCLINATION && heights.filter((_, k) => k !== long).some(height => height < MAX_INCLINATION)
  );
}
