// The switch of the springs view, and what its colours and strokes mean in newtons.

import { figures, forceAt, unitOf } from './scale';

/** Places on the scale that the legend names. */
const PLACES = [-1, -0.5, 0, 0.5, 1];

const get = <T extends Element = HTMLElement>(id: string) => document.getElementById(id) as unknown as T;

export interface LegendActions {
  toggle(): void;
  /** Gives rigid blocks springs. */
  useSprings(): void;
}

export class Legend {
  private readonly button = get<HTMLButtonElement>('springs-toggle');
  private readonly values = [...document.querySelectorAll<HTMLElement>('#scale-values span')];
  private shown = '';

  constructor(actions: LegendActions) {
    this.button.addEventListener('click', () => actions.toggle());
    const use = get<HTMLButtonElement>('use-springs');
    use.addEventListener('click', () => {
      // The button goes away, and must not take a key of the game with it.
      use.blur();
      actions.useSprings();
    });
  }

  /** Shows whether the view is on, and the force at the end of the scale (N; null where the blocks have no springs). */
  show(on: boolean, end: number | null): void {
    const unit = unitOf(end ?? 0);
    const values = PLACES.map(place => figures(forceAt(place, end ?? 0), unit));
    const shown = JSON.stringify([on, end === null, unit, values]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.button.setAttribute('aria-pressed', String(on));
    get('scale').hidden = !on || end === null;
    get('no-springs').hidden = !on || end !== null;
    get('scale-unit').textContent = unit;
    this.values.forEach((span, i) => (span.textContent = values[i]));
  }
}
