// The switch and the legend of the X-ray.

import { text } from '../messages';
import { element, onClick } from '../ui/dom';
import { describe } from './appearance';
import { colourOf, isLoose, LOOSE, type Reading } from './readings';
import { fillScale } from './scale';

export interface XRayState {
  on: boolean;
  /** Reading of each block; null while the tower moves. */
  readings: Reading[] | null;
  paused: boolean;
  /** Block to describe. */
  body: number | null;
  /** Number of figures for which there is no room on the screen. */
  cramped: number;
}

export class XRayLegend {
  private readonly button = element<HTMLButtonElement>('xray-toggle');
  private shown = '';

  constructor(toggle: () => void) {
    onClick('xray-toggle', toggle);
    fillScale(element('xray-bar'), element('xray-ticks'));
    element('xray-swatch').style.background = `rgb(${colourOf(LOOSE).map(c => Math.round(255 * c))})`;
  }

  show({ on, readings, paused, body, cramped }: XRayState): void {
    const loose = readings?.filter(isLoose).length ?? 0;
    const count = readings ? text.xray.loose(loose, readings.length) : paused ? text.xray.paused : text.xray.settling;
    const tilted = readings?.some(({ pull }) => pull === null) ? text.xray.tilted : '';
    const hint = readings && cramped > 0 ? text.xray.zoom : tilted;
    const details = readings && body !== null ? describe(body, readings[body]) : hint;
    const shown = JSON.stringify([on, count, details]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.button.setAttribute('aria-pressed', String(on));
    element('xray').hidden = !on;
    element('xray-count').textContent = count;
    element('xray').classList.toggle('settling', readings === null);
    element('xray-block').textContent = details;
  }
}
