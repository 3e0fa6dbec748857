// The switches of the springs view and of the X-ray, and what their colours and strokes mean in newtons.

import { figures, forceAt, unitOf } from './scale';
import { colourOf, forceText, GRADIENT, isLoose, LOOSE, placeOf, TICKS, type Reading } from './xray';

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

export interface XRayState {
  on: boolean;
  /** What there is to say of each block; null while the tower moves. */
  readings: Reading[] | null;
  paused: boolean;
  /** The block that is pointed at or was tapped. */
  asked: number | null;
  /** Number of figures for which there is no room on the screen. */
  cramped: number;
}

export class XRayLegend {
  private readonly button = get<HTMLButtonElement>('xray-toggle');
  private shown = '';

  constructor(toggle: () => void) {
    this.button.addEventListener('click', toggle);
    get('xray-bar').style.background = GRADIENT;
    get('xray-swatch').style.background = `rgb(${colourOf(LOOSE).map(c => Math.round(255 * c))})`;
    const ticks = TICKS.map(force => {
      const span = document.createElement('span');
      span.textContent = String(force);
      span.style.left = `${100 * placeOf(force)}%`;
      return span;
    });
    get('xray-ticks').replaceChildren(...ticks);
  }

  show({ on, readings, paused, asked, cramped }: XRayState): void {
    const loose = readings?.filter(isLoose).length ?? 0;
    const count = readings ? `${loose} of ${readings.length} loose` : paused ? 'paused in motion' : 'settling…';
    const askew = readings?.some(({ pull }) => pull === null) ? 'Grey: not lying level.' : '';
    const hint = readings && cramped > 0 ? 'Come closer for more figures.' : askew;
    const told = readings && asked !== null ? tell(asked, readings[asked]) : hint;
    const shown = JSON.stringify([on, count, told]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.button.setAttribute('aria-pressed', String(on));
    get('xray').hidden = !on;
    get('xray-count').textContent = count;
    get('xray').classList.toggle('settling', readings === null);
    get('xray-block').textContent = told;
  }
}

function tell(body: number, { load, pull }: Reading): string {
  const start = pull === null ? 'lies on nothing or askew' : `pull ${forceText(pull)} N`;
  return `Block ${body}: ${start}, carries ${load < 0.005 ? 'nothing' : `${forceText(load)} N`}`;
}
