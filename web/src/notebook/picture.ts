// The picture of a widget: the view of the page, drawn only when something changes.

import { Bodies } from '../view/bodies';
import { Orbit } from '../view/orbit';
import { pick } from '../view/picking';
import { Quality, TIERS } from '../view/quality';
import { TowerView } from '../view/tower-view';
import { labelOf, stainOf } from '../xray/appearance';
import { Labels } from '../xray/labels';
import type { Reading } from '../xray/readings';

/** Azimuth of the first view, rad: that of the page. */
const FIRST_AZIMUTH = -0.95;
/** Opacity of the colours of the X-ray. */
const STAIN = 0.92;
/** Longest time step of the camera, s. */
const MAX_CAMERA_STEP = 0.1;
/** Time after which figures are put onto the faces that are then visible, ms. */
const LABEL_DELAY = 150;

export class Picture {
  readonly orbit = new Orbit(matchMedia('(prefers-reduced-motion: reduce)').matches, false);
  bodies: Bodies | null = null;
  /** Called before each picture with the time since the last, s; returns the largest change, m. */
  advance: (elapsed: number) => { change: number; goesOn: boolean } = () => ({ change: 0, goesOn: false });
  private readonly view: TowerView;
  private readonly labels: Labels;
  private readonly quality = new Quality(matchMedia('(hover: none)').matches ? 1 : TIERS.length - 1, false);
  private readonly observer: ResizeObserver;
  private readonly colours = matchMedia('(prefers-color-scheme: dark)');
  private readonly recolour = () => this.setDark();
  private pending = 0;
  private delayed = 0;
  private tickedAt = 0;
  private consecutive = false;
  private resized = true;

  /** Throws where the browser has no WebGL 2. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    labels: HTMLElement,
  ) {
    this.view = new TowerView(canvas, this.orbit, 1);
    this.labels = new Labels(labels);
    this.observer = new ResizeObserver(() => {
      this.resized = true;
      this.request();
    });
    this.observer.observe(canvas);
    this.colours.addEventListener('change', this.recolour);
    this.setDark();
  }

  /** Begins with new blocks: their sizes, m, and poses. */
  begin(sizes: Float32Array, poses: Float32Array): void {
    const first = this.bodies === null;
    this.bodies = new Bodies(sizes, poses);
    this.view.begin(this.bodies);
    this.labels.set(null);
    if (first) this.orbit.frame(this.bodies.top(), FIRST_AZIMUTH);
    this.request();
  }

  /** Shows the X-ray of all blocks; null leaves wood. */
  xray(readings: Reading[] | null): void {
    this.view.stain(readings?.map(stainOf) ?? null, STAIN);
    this.labels.set(readings?.map(labelOf) ?? null);
    this.request();
  }

  /** Frames all blocks. */
  frame(): void {
    if (this.bodies) this.orbit.frame(this.bodies.top());
    this.request();
  }

  /** Returns the block at a position of the canvas, px; null for none. */
  blockAt(x: number, y: number): number | null {
    return this.bodies && (pick(this.bodies, this.orbit.camera.position, this.orbit.ray(x, y))?.body ?? null);
  }

  /** Outlines a block; null for none. */
  select(body: number | null): void {
    if (!this.bodies) return;
    const none = { hovered: null, held: null, holders: [], slots: [], target: null, slotSize: null };
    this.view.marks.show(this.bodies, { ...none, selected: body });
    this.view.invalidate();
    this.request();
  }

  /** Draws at the next opportunity. */
  request(): void {
    this.pending ||= requestAnimationFrame(time => this.tick(time / 1000));
  }

  /** Frees the graphics, of which a browser has few. */
  dispose(): void {
    cancelAnimationFrame(this.pending);
    clearTimeout(this.delayed);
    this.pending = -1;
    this.observer.disconnect();
    this.colours.removeEventListener('change', this.recolour);
    this.view.dispose();
  }

  private tick(now: number): void {
    this.pending = 0;
    if (!this.bodies) return;
    const elapsed = this.consecutive ? now - this.tickedAt : 0;
    this.tickedAt = now;
    if (this.consecutive && this.quality.sample(elapsed)) this.resized = true;
    if (this.resized) this.fit();
    const { change, goesOn } = this.advance(elapsed);
    const moved = this.orbit.update(Math.min(elapsed || 1 / 60, MAX_CAMERA_STEP));
    const followed = this.view.follow(this.bodies, change);
    this.labels.follow(this.bodies, this.orbit, followed || moved, now);
    this.view.draw();
    this.consecutive = moved || goesOn;
    if (this.consecutive) this.request();
    else if (followed) this.later();
  }

  /** Draws once more when the faces that are visible are known. */
  private later(): void {
    clearTimeout(this.delayed);
    this.delayed = window.setTimeout(() => this.request(), LABEL_DELAY);
  }

  private fit(): void {
    this.resized = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.orbit.resize(width, height);
    this.view.resize(width, height, this.quality.tier);
  }

  /** Follows the theme of the notebook where it has one, else the colour scheme of the system. */
  private setDark(): void {
    const light = document.body.dataset.jpThemeLight;
    const dark = light === undefined ? this.colours.matches : light === 'false';
    this.canvas.parentElement?.classList.toggle('teeter-dark', dark);
    this.view.setDark(dark);
    this.request();
  }
}
