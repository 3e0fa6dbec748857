// The switch and the legend of the springs view.

import { forceAt, formatForce, unitOf } from '../view/force-scale';
import { element, onClick } from './dom';

/** Levels of the scale that the legend labels. */
const LEVELS = [-1, -0.5, 0, 0.5, 1];

export class SpringsLegend {
  private readonly button = element<HTMLButtonElement>('springs-toggle');
  private readonly values = [...document.querySelectorAll<HTMLElement>('#scale-values span')];
  private shown = '';

  /** `useSprings` gives rigid blocks springs. */
  constructor(toggle: () => void, useSprings: () => void) {
    this.button.addEventListener('click', toggle);
    onClick('use-springs', () => {
      // The button disappears, and must not keep the focus of the keys.
      element('use-springs').blur();
      useSprings();
    });
  }

  /**
   * Shows the switch and the scale, which ends at a force (N); null where the blocks have no
   * springs.
   */
  show(on: boolean, end: number | null): void {
    const unit = unitOf(end ?? 0);
    const values = LEVELS.map(level => formatForce(forceAt(level, end ?? 0), unit));
    const shown = JSON.stringify([on, end === null, unit, values]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.button.setAttribute('aria-pressed', String(on));
    element('scale').hidden = !on || end === null;
    element('no-springs').hidden = !on || end !== null;
    element('scale-unit').textContent = unit;
    this.values.forEach((span, i) => (span.textContent = values[i]));
  }
}
