// Controls and readouts beside the tower of the museum.

import type { Options, Range } from '../app/url';
import type { Hand } from '../hand/hand';
import { count, decimal, text } from '../messages';
import { element, onClick, setText } from '../ui/dom';
import { millimetres, type TowerDistance } from './distance';
import type { MuseumFrame, MuseumSetup, Show } from './protocol';
import type { MuseumStore } from './state';

const ROWS: Range & { default: number } = { min: 3, max: 18, default: 6 };
const SHOWS: readonly Show[] = ['old', 'engine', 'both'];
/** Scenes of the dissertation, as in the list of the page. */
const SCENES = ['test-1', 'test-2', 'test-2-out', 'test-2-taken', 'test-3', 'test-4', 'test-5', 'test-6', 'moves'];

export interface ControlActions {
  build(change: Partial<MuseumSetup>): void;
  pause(): void;
  springs(): void;
  letGo(): void;
}

export interface Readouts {
  frame: MuseumFrame;
  /** Pictures per second. */
  fps: number;
  distance: TowerDistance | null;
  blocks: number;
  /** End of the scale of the springs; empty where they are not drawn. */
  springs: string;
}

const TOWER = text.museum.tower;

/** Reads the setup of the towers from the address. */
export function readSetup(options: Options): MuseumSetup {
  const query = new URLSearchParams(location.search);
  const rows = query.has('rows') ? options.rows : ROWS.default;
  return {
    show: SHOWS.find(show => show === query.get('show')) ?? 'old',
    rows: Math.min(ROWS.max, Math.max(ROWS.min, rows)),
    seed: options.seed,
    scene: SCENES.includes(query.get('scene') ?? '') ? query.get('scene') : null,
    constants: {},
  };
}

export class Controls {
  private readonly shows = [...document.querySelectorAll<HTMLInputElement>('input[name="show"]')];
  private readonly rows = element<HTMLInputElement>('rows');
  private readonly scene = element<HTMLSelectElement>('scene');
  private readonly hands = [...document.querySelectorAll<HTMLInputElement>('input[name="hand-of"]')];

  constructor(store: MuseumStore, hand: Hand, actions: ControlActions) {
    const { rows, scene } = this;
    rows.min = String(ROWS.min);
    rows.max = String(ROWS.max);
    for (const input of this.shows)
      input.addEventListener('change', () => actions.build({ show: input.value as Show }));
    rows.addEventListener('input', () => setText('rows-value', rows.value));
    rows.addEventListener('change', () => actions.build({ rows: Number(rows.value) }));
    scene.addEventListener('change', () => actions.build({ scene: scene.value || null }));
    for (const input of this.hands)
      input.addEventListener('change', () => store.set({ oldHand: input.value === 'old' }));
    onClick('restart', () => actions.build({}));
    onClick('pause', () => actions.pause());
    onClick('springs', () => actions.springs());
    onClick('place', () => hand.place());
    onClick('turn', () => hand.turn(Math.PI / 2));
    onClick('let-go', () => actions.letGo());
    store.subscribe(['setup', 'oldHand'], ({ setup, oldHand }) => this.showSetup(setup, oldHand));
    store.subscribe(['paused'], ({ paused }) => setPressed('pause', paused));
    store.subscribe(['springs'], ({ springs }) => setPressed('springs', springs));
  }

  /** Enables the buttons for a block that can be placed, is held, and is carried. */
  showHand(placeable: boolean, held: boolean, carried: boolean): void {
    element<HTMLButtonElement>('place').disabled = !placeable;
    element<HTMLButtonElement>('let-go').disabled = !held;
    element<HTMLButtonElement>('turn').disabled = !carried;
  }

  showReadouts({ frame, fps, distance, blocks, springs }: Readouts): void {
    setText('n-time', TOWER.pace(text.readouts.seconds(frame.update.report.time, 1), frame.factor));
    element('n-time').classList.toggle('slow', frame.factor < 0.95);
    setText('n-fps', count(fps));
    setText('n-old', formatCost(frame.costs.old));
    setText('n-engine', formatCost(frame.costs.engine));
    if (distance) {
      setText('n-apart', millimetres(distance.max));
      setText('n-mean', TOWER.mean(millimetres(distance.mean)));
    }
    if (frame.old) {
      const { tests, rounds, active, unresolved } = frame.old;
      const [all, exact, hits] = [tests.potential, tests.after_planes, tests.collisions].map(count);
      setText('n-tests', TOWER.testCounts(all, exact, hits));
      setText('n-rounds', count(rounds));
      setText('n-left', unresolved > 0 ? count(unresolved) : '');
      setText('n-disabled', TOWER.disabledOf(blocks - active, blocks));
    }
    setText('n-springs', springs);
  }

  private showSetup({ show, scene, rows }: MuseumSetup, oldHand: boolean): void {
    for (const input of this.shows) input.checked = input.value === show;
    this.rows.value = String(rows);
    setText('rows-value', String(rows));
    this.scene.value = scene ?? '';
    this.rows.disabled = scene !== null;
    for (const input of this.hands) input.checked = (input.value === 'old') === oldHand;
    const of2003 = oldHand && show === 'old';
    element('place').hidden = of2003;
    element('note-game').hidden = of2003 || show === 'engine';
    element('note-2003').hidden = !of2003;
    setText('shown', TOWER.shown[show]);
    element('springs').hidden = show !== 'old';
    element('turn').hidden = show === 'old';
    for (const row of document.querySelectorAll<HTMLElement>('[data-of]'))
      row.hidden = !row.dataset.of!.split(' ').includes(show);
  }
}

function setPressed(id: string, pressed: boolean): void {
  element(id).setAttribute('aria-pressed', String(pressed));
}

function formatCost(seconds: number | null): string {
  if (seconds === null) return '';
  const ms = 1000 * seconds;
  const rate = ms < 1 ? TOWER.over(1000) : count(1 / seconds);
  return TOWER.cost(decimal(ms, ms < 10 ? 2 : 0), rate);
}
