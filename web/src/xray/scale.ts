// The colour scale of the X-ray: a bar, and its ticks in newtons.

import { significant } from '../messages';
import { create } from '../ui/dom';
import { GRADIENT, levelOf, TICKS } from './readings';

/** Fills the bar and the line of ticks of a legend. */
export function fillScale(bar: HTMLElement, ticks: HTMLElement): void {
  bar.style.background = GRADIENT;
  ticks.replaceChildren(
    ...TICKS.map(force => {
      const tick = create('span', {}, significant(force, 2));
      tick.style.left = `${100 * levelOf(force)}%`;
      return tick;
    }),
  );
}
