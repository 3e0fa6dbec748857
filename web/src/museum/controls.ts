// Controls and readouts beside the tower.

import type { Options } from '../query';
import { millimetres, type Apart } from './apart';
import type { MuseumFrame, Order, Show } from './protocol';

export const ROWS = { least: 3, most: 18, usual: 6 };

export interface ControlActions {
  build(): void;
  pause(): void;
  springs(): void;
  place(): void;
  turn(): void;
  letGo(): void;
}

export interface Readouts {
  frame: MuseumFrame;
  /** Pictures a second. */
  fps: number;
  apart: Apart | null;
  blocks: number;
  /** End of the scale of the springs, in words; empty where they are not shown. */
  springs: string;
}

const get = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;
const SHOWN: Record<Show, string> = {
  old: 'Wood is the tower of 2003.',
  engine: 'Wood is the tower of the engine.',
  both: 'Wood is the tower of the engine, the blue ghost that of 2003, given the same hand.',
};

export class Controls {
  private readonly shows = [...document.querySelectorAll<HTMLInputElement>('input[name="show"]')];
  private readonly rows = get<HTMLInputElement>('rows');
  private readonly future = get<HTMLInputElement>('future');
  private readonly pause = get<HTMLButtonElement>('pause');
  private readonly springs = get<HTMLButtonElement>('springs');
  private readonly place = get<HTMLButtonElement>('place');
  private readonly turn = get<HTMLButtonElement>('turn');
  private readonly letGo = get<HTMLButtonElement>('let-go');

  constructor(
    private readonly options: Options,
    actions: ControlActions,
  ) {
    const query = new URLSearchParams(location.search);
    const show = this.shows.find(input => input.value === query.get('show')) ?? this.shows[0];
    show.checked = true;
    this.rows.min = String(ROWS.least);
    this.rows.max = String(ROWS.most);
    this.rows.value = String(query.has('rows') ? options.rows : ROWS.usual);
    this.tellRows();
    for (const input of [...this.shows, this.rows, this.future])
      input.addEventListener('change', () => actions.build());
    this.rows.addEventListener('input', () => this.tellRows());
    get('restart').addEventListener('click', () => actions.build());
    this.pause.addEventListener('click', () => actions.pause());
    this.springs.addEventListener('click', () => actions.springs());
    this.place.addEventListener('click', () => actions.place());
    this.turn.addEventListener('click', () => actions.turn());
    this.letGo.addEventListener('click', () => actions.letGo());
  }

  order(): Order {
    return {
      show: this.shows.find(input => input.checked)!.value as Show,
      rows: Number(this.rows.value),
      seed: this.options.seed,
      future: this.future.checked,
    };
  }

  setShow(show: Show): void {
    put('shown', SHOWN[show]);
    this.future.disabled = show === 'engine';
    this.springs.hidden = show !== 'old';
    this.turn.hidden = show === 'old';
    for (const row of document.querySelectorAll<HTMLElement>('[data-of]'))
      row.hidden = !row.dataset.of!.split(' ').includes(show);
  }

  setPaused(paused: boolean): void {
    this.pause.setAttribute('aria-pressed', String(paused));
  }

  setSprings(shown: boolean): void {
    this.springs.setAttribute('aria-pressed', String(shown));
  }

  setPlaceable(can: boolean, held: boolean, carried: boolean): void {
    this.place.disabled = !can;
    this.letGo.disabled = !held;
    this.turn.disabled = !carried;
  }

  read({ frame, fps, apart, blocks, springs }: Readouts): void {
    put('n-time', `${frame.time.toFixed(1)} s, at ${frame.factor.toFixed(2)}× of real time`);
    get('n-time').classList.toggle('slow', frame.factor < 0.95);
    put('n-fps', fps.toFixed(0));
    put('n-old', cost(frame.costs.old));
    put('n-engine', cost(frame.costs.engine));
    if (apart) {
      put('n-apart', millimetres(apart.most));
      put('n-mean', `${millimetres(apart.mean)} in the mean`);
    }
    if (frame.old) {
      const { potential, exact, collisions, rounds, active, unresolved } = frame.old;
      put('n-tests', `${grouped(potential)} → ${grouped(exact)} exact → ${grouped(collisions)} hits`);
      put('n-rounds', String(rounds));
      put('n-left', unresolved > 0 ? String(unresolved) : '');
      put('n-disabled', `${blocks - active} of ${blocks}`);
    }
    put('n-springs', springs);
  }

  private tellRows(): void {
    put('rows-value', this.rows.value);
  }
}

function cost(seconds: number | null): string {
  if (seconds === null) return '';
  const ms = 1000 * seconds;
  const rate = ms < 1 ? 'over 1000' : (1 / seconds).toFixed(0);
  return `${ms.toFixed(ms < 10 ? 2 : 0)} ms a frame, ${rate} frames/s`;
}

function grouped(n: number): string {
  return n.toLocaleString('en').replaceAll(',', '\u202f');
}

function put(id: string, text: string): void {
  const element = get(id);
  if (element.textContent !== text) element.textContent = text;
}
