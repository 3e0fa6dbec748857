// An exhibit in the plane: its text and controls, and a canvas on which a pointer pulls blocks. Its
// worker starts when it first comes onto the screen and is paused while it is not.

import { significant, text } from '../messages';
import { setText } from '../ui/dom';
import type { Exhibit, Scenery } from './catalogue';
import { Chart } from './chart';
import { PlanePicture, WIDE, type Colours } from './plane-picture';
import type { FromPlane, PlaneFrame, PlaneSetup, ToPlane } from './protocol';

const PLANE = text.museum.plane;
/** Speeds to choose from: simulated time per wall time; 0 pauses. */
const SPEEDS: readonly [number, string][] = [
  [1, PLANE.real],
  [0.1, PLANE.slower(10)],
  [0.01, PLANE.slower(100)],
  [0, PLANE.stopped],
];
/** Height above the highest block at which one is dropped, and offsets from the axis in turn, m. */
const DROP = { above: 0.03, beside: [0.012, -0.02, 0.004, -0.008] };
/** Position, m, and velocity, m/s, of a thrown block. */
const THROW = { x: -WIDE / 2 + 0.045, vx: 1.2, vy: 0.5 };

/** Read-only access to an exhibit for tests. */
export interface PlaneInspect {
  readonly scene: number;
  readonly blocks: number;
  readonly counts: PlaneFrame['counts'] | null;
  readonly corners: number[];
}

export class ExhibitView {
  readonly element: HTMLElement;
  private readonly canvas: HTMLCanvasElement;
  private readonly picture: PlanePicture;
  private readonly chart = new Chart();
  private readonly scenery: HTMLSelectElement;
  private readonly speed: HTMLSelectElement;
  private readonly counters: HTMLElement[] = [];
  private readonly pace: HTMLElement;
  private readonly note: HTMLElement;
  private worker: Worker | null = null;
  private scene = 0;
  private last: PlaneFrame | null = null;
  private drops = 0;
  private onScreen = false;
  private drawing = false;
  private max = 0;

  constructor(
    private readonly exhibit: Exhibit,
    template: HTMLTemplateElement,
    private readonly colours: () => Colours,
  ) {
    const fragment = template.content.cloneNode(true) as DocumentFragment;
    this.element = fragment.firstElementChild as HTMLElement;
    const get = <T extends HTMLElement>(part: string) => this.element.querySelector<T>(`[data-part="${part}"]`)!;
    this.element.dataset.method = exhibit.method;
    const title = get('title');
    title.textContent = exhibit.title;
    title.id = `title-${exhibit.method}`;
    this.element.setAttribute('aria-labelledby', title.id);
    get('chapter').textContent = exhibit.chapter;
    get('text').textContent = exhibit.text;
    this.canvas = get<HTMLCanvasElement>('canvas');
    this.canvas.setAttribute('aria-label', PLANE.picture(exhibit.title));
    this.picture = new PlanePicture(this.canvas, exhibit.iterations !== '');
    this.scenery = get<HTMLSelectElement>('scenery');
    this.scenery.append(...exhibit.sceneries.map((s, i) => new Option(s.label, String(i))));
    this.speed = get<HTMLSelectElement>('speed');
    this.speed.append(...SPEEDS.map(([speed, label]) => new Option(label, String(speed))));
    this.pace = get('pace');
    this.note = get('note');
    this.fillCounters(get('counters'));
    this.listenToControls(get);
    this.listenToCanvas();
    this.speed.value = String(this.chosen.speed);
  }

  /** Takes whether the exhibit is on the screen; the first time starts its worker. */
  setOnScreen(onScreen: boolean): void {
    this.onScreen = onScreen;
    if (onScreen && !this.worker) {
      this.worker = new Worker(new URL('./plane-worker.ts', import.meta.url), { type: 'module' });
      this.worker.onmessage = (event: MessageEvent<FromPlane>) => this.receive(event.data);
      this.worker.onerror = event => this.showNote(event.message || PLANE.notStarted);
      this.restart(true);
    } else {
      this.sendSpeed();
    }
  }

  /** Draws the picture again, as after a change of colours or size. */
  invalidate(): void {
    if (this.drawing) return;
    this.drawing = true;
    requestAnimationFrame(() => {
      this.drawing = false;
      if (this.last) this.picture.draw(this.last, this.chart, this.exhibit.limit ?? 1, this.colours());
    });
  }

  get inspect(): PlaneInspect {
    const { last } = this;
    return {
      scene: last?.scene ?? 0,
      blocks: (last?.corners.length ?? 0) / 8,
      counts: last?.counts ?? null,
      corners: Array.from(last?.corners ?? []),
    };
  }

  /** Position on the canvas (CSS px) of a position in the plane (m). */
  screen(x: number, y: number): { x: number; y: number } {
    return this.picture.screen(x, y);
  }

  private get chosen(): Scenery {
    return this.exhibit.sceneries[Number(this.scenery.value)];
  }

  private fillCounters(list: HTMLElement): void {
    const rows: string[] = [];
    if (this.exhibit.iterations) rows.push(PLANE.inStep(this.exhibit.iterations));
    rows.push(...this.exhibit.counters.map(([name]) => name));
    for (const name of rows) {
      const row = document.createElement('div');
      const [term, value] = [document.createElement('dt'), document.createElement('dd')];
      term.textContent = name;
      row.append(term, value);
      list.append(row);
      this.counters.push(value);
    }
  }

  private restart(resetSpeed: boolean): void {
    if (!this.worker) return;
    const { setting, count, gap, stiffness, speed } = this.chosen;
    if (resetSpeed) this.speed.value = String(speed);
    this.chart.clear();
    this.max = this.drops = 0;
    this.showNote('');
    const setup: PlaneSetup = { method: this.exhibit.method, setting, count, gap, stiffness };
    this.send({ type: 'build', scene: ++this.scene, setup });
    this.sendSpeed();
  }

  private sendSpeed(): void {
    this.send({ type: 'speed', speed: this.onScreen ? Number(this.speed.value) : 0 });
  }

  private single(): void {
    this.speed.value = '0';
    this.sendSpeed();
    this.send({ type: 'single' });
  }

  private top(): number {
    let top = 0;
    const { corners } = this.last ?? { corners: [] };
    for (let at = 1; at < corners.length; at += 2) top = Math.max(top, corners[at]);
    return top;
  }

  private drop(): void {
    const x = DROP.beside[this.drops++ % DROP.beside.length];
    // Within the picture, however high the stack.
    const { y: highest } = this.picture.positionAt(0, 12);
    const top = this.top();
    this.send({ type: 'add', x, y: Math.max(top + 0.012, Math.min(top + DROP.above, highest)), vx: 0, vy: 0 });
  }

  private throw(): void {
    this.send({ type: 'add', x: THROW.x, y: Math.max(0.03, 0.6 * this.top()), vx: THROW.vx, vy: THROW.vy });
  }

  private listenToControls(get: (part: string) => HTMLElement): void {
    this.scenery.addEventListener('change', () => this.restart(true));
    this.speed.addEventListener('change', () => this.sendSpeed());
    get('restart').addEventListener('click', () => this.restart(false));
    get('drop').addEventListener('click', () => this.drop());
    get('throw').addEventListener('click', () => this.throw());
    get('single').addEventListener('click', () => this.single());
  }

  private listenToCanvas(): void {
    const { canvas } = this;
    const at = (event: PointerEvent) => this.picture.positionAt(event.offsetX, event.offsetY);
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      this.send({ type: 'hold', ...at(event) });
    });
    canvas.addEventListener('pointermove', event => {
      if (event.buttons !== 0) this.send({ type: 'drag', ...at(event) });
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
      canvas.addEventListener(end, () => this.send({ type: 'release' }));
    canvas.addEventListener('keydown', event => {
      if (event.key === 'ArrowRight') this.throw();
      else if (event.key === 'ArrowDown') this.drop();
      else if (event.key === 'r') this.restart(false);
      else return;
      event.preventDefault();
    });
  }

  private receive(message: FromPlane): void {
    if (message.type === 'failed') return this.showNote(PLANE.failed(message.message));
    if (message.type === 'refused') return this.showNote(message.message);
    // A fault of the page.
    if (message.type === 'invalid') return console.error(new Error(message.message));
    if (message.scene !== this.scene) return;
    const { counts, factor } = message;
    // Without a step of the method the counters of the last one stay.
    const stepped = counts.time !== (this.last?.counts.time ?? 0) && counts.time > 0;
    if (!stepped && this.last) counts.most = this.last.counts.most;
    if (stepped) this.chart.add(counts.most);
    this.last = message;
    this.max = Math.max(this.max, counts.most);
    const values = this.exhibit.counters.map(([, value]) => value(counts));
    if (this.exhibit.iterations) values.unshift(PLANE.max(counts.most, this.max));
    values.forEach((value, i) => setText(this.counters[i], value));
    const wanted = Number(this.speed.value);
    const behind = wanted > 0 && factor < 0.8 * wanted && counts.time > 0.05;
    const time = text.readouts.seconds(counts.time, 3);
    setText(this.pace, behind ? PLANE.behind(time, significant(factor, 2)) : time);
    this.invalidate();
  }

  private showNote(text: string): void {
    setText(this.note, text);
  }

  private send(message: ToPlane): void {
    this.worker?.postMessage(message);
  }
}
