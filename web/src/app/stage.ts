// The stage of a page: camera, picture of the tower, and the loop that draws it. The game and the
// museum share it.

import { Vector3 } from 'three';
import type { Built, Frame } from '../engine/protocol';
import { FRAME, type TimedReport, type Vec } from '../engine/game-protocol';
import { Blend, Rate } from '../engine/pacing';
import type { Hand } from '../hand/hand';
import { ForceRing, ringState, type RingState } from '../ui/force-ring';
import { element } from '../ui/dom';
import { Bodies } from '../view/bodies';
import { ForceScale } from '../view/force-scale';
import { Lattices, maxForce } from '../view/lattice';
import { Orbit } from '../view/orbit';
import { Quality, TIERS } from '../view/quality';
import { TowerView } from '../view/tower-view';
import type { PlayStore } from './state';
import type { Options } from './url';

/** Azimuth of the first view, rad: a corner, so that ends and sides are visible. */
const FIRST_AZIMUTH = -0.95;
/** Height of the tower that is framed before one is built, m. */
const DEFAULT_TOP = 0.33;
/** Time between readouts, s. */
const READOUT_INTERVAL = 0.25;
/** Longest time step of the camera, s. */
const MAX_CAMERA_STEP = 0.1;

/** Parts of the picture that differ from page to page. */
export interface Show {
  /** True while the springs are drawn. */
  springs(): boolean;
  /** Blocks outlined as holders of the held one. */
  holders(): number[];
  /** Called four times a second. */
  readout(): void;
  /** Called in every loop, `elapsed` seconds after the last. */
  update?(elapsed: number): void;
  /** False pauses the loop. */
  visible?(): boolean;
  /** Changes the ring. */
  ring?(state: RingState | null): RingState | null;
  /**
   * Moves further objects to fraction `t` between the last two states; returns true if the picture
   * changes.
   */
  blend?(t: number): boolean;
  /** Follows the blocks; `moved`: they or the camera have moved. `now`: s. */
  follow?(moved: boolean, now: number): void;
}

export class Stage {
  readonly canvas = element<HTMLCanvasElement>('picture');
  readonly orbit = new Orbit(matchMedia('(prefers-reduced-motion: reduce)').matches);
  readonly view: TowerView;
  readonly quality: Quality;
  /** Scale of the forces in the springs view. */
  readonly forces = new ForceScale();
  bodies: Bodies | null = null;
  /** Longest time of one picture, ms. */
  maxPictureTime = 0;
  private readonly ring = new ForceRing();
  private readonly lattices = new Lattices();
  private readonly interpolation = new Blend(FRAME);
  private readonly pictures = new Rate();
  private resized = true;
  private drewLast = false;
  private drawnAt = 0;
  private readAt = 0;
  private tickedAt = performance.now() / 1000;

  /** `zoom`: factor on the distance of a framed tower. Throws where the browser has no WebGL 2. */
  constructor(
    private readonly options: Options,
    private readonly store: PlayStore,
    private readonly zoom = 1,
  ) {
    this.view = new TowerView(this.canvas, this.orbit, options.scale);
    const touch = matchMedia('(hover: none)').matches;
    this.quality = new Quality(options.tier ?? (touch ? 1 : TIERS.length - 1), options.tier !== null);
    new ResizeObserver(() => (this.resized = true)).observe(this.canvas);
    store.subscribe(['dark'], ({ dark }) => this.view.setDark(dark));
  }

  /** True once a picture has been drawn. */
  get drawn(): boolean {
    return this.drawnAt > 0;
  }

  /** Pictures per second. */
  get fps(): number {
    return this.pictures.perSecond();
  }

  /** Begins with a new world. */
  begin(world: Built): void {
    const first = this.bodies === null;
    this.bodies = new Bodies(world.sizes, world.poses, world.particleOffset);
    this.lattices.arrive(null);
    this.forces.reset();
    this.view.begin(this.bodies);
    // A turn that is taken back leaves the camera where it is.
    if (first || !world.resumed) this.frame(first ? FIRST_AZIMUTH : undefined);
  }

  receive({ poses, lattices }: Frame<TimedReport>): void {
    this.bodies?.arrive(poses, lattices);
    this.lattices.arrive(lattices);
    this.interpolation.arrive(performance.now() / 1000);
  }

  /** Frames the whole tower. */
  frame(azimuth?: number): void {
    this.orbit.frame(this.bodies?.top() ?? DEFAULT_TOP, azimuth);
    if (this.zoom !== 1) this.orbit.zoom(this.zoom);
  }

  /** Returns the position on the screen of a point in the world (m): -1 left to 1 right. */
  sideOf(point: Vec): number {
    return (2 * this.orbit.project(new Vector3(...point)).x) / this.canvas.clientWidth - 1;
  }

  /** Draws the whole picture again, at its size. */
  redraw(): void {
    this.view.invalidate();
    this.resized = true;
  }

  /** Starts the loop. */
  run(hand: Hand, show: Show): void {
    const tick = () => {
      requestAnimationFrame(tick);
      this.tick(hand, show);
    };
    requestAnimationFrame(tick);
  }

  private tick(hand: Hand, show: Show): void {
    const now = performance.now() / 1000;
    const elapsed = now - this.tickedAt;
    this.tickedAt = now;
    if (show.visible && !show.visible()) return;
    this.pictures.add(now);
    // Only the time between two drawn pictures measures the cost of drawing.
    if (this.drewLast && this.quality.sample(elapsed)) this.resized = true;
    this.drewLast = false;
    if (this.resized) this.fit();
    if (!this.bodies) return;
    if (hand.holds && !this.store.state.paused) this.orbit.halt();
    const moved = this.orbit.update(Math.min(elapsed, MAX_CAMERA_STEP));
    const t = this.interpolation.at(now);
    const change = this.bodies.blend(t);
    let changed = this.showSprings(t, elapsed, show);
    if (show.blend?.(t)) changed = true;
    if (this.showMarks(this.bodies, hand, show)) changed = true;
    const ring = ringState(hand, this.store.state.maxForce, this.bodies, this.orbit);
    this.ring.show(show.ring ? show.ring(ring) : ring);
    if (now - this.readAt > READOUT_INTERVAL) {
      this.readAt = now;
      show.readout();
    }
    show.update?.(Math.min(elapsed, MAX_CAMERA_STEP));
    if (this.options.render === 'once' && now - this.drawnAt < 1) return;
    const followed = this.view.follow(this.bodies, change);
    show.follow?.(followed || moved, now);
    if (followed || moved || changed || !this.drawn) this.draw(now);
  }

  private fit(): void {
    this.resized = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.orbit.resize(width, height);
    this.view.resize(width, height, this.quality.tier);
    if (this.bodies && !this.drawn) this.frame(FIRST_AZIMUTH);
  }

  private showSprings(t: number, elapsed: number, show: Show): boolean {
    const changed = this.lattices.blend(t);
    const springs = show.springs() ? this.lattices.shown : null;
    if (springs) this.forces.follow(maxForce(springs), elapsed);
    this.view.showSprings(springs, this.forces.end);
    return changed && show.springs();
  }

  private showMarks(bodies: Bodies, hand: Hand, show: Show): boolean {
    const { hovered, selected, pointing } = this.store.state;
    return this.view.marks.show(bodies, {
      hovered: pointing ? null : hovered,
      held: hand.held?.body ?? hand.body,
      selected,
      holders: show.holders(),
      slots: hand.slots,
      target: hand.held?.slot ?? null,
      slotSize: hand.held && bodies.size(hand.held.body),
    });
  }

  private draw(now: number): void {
    const before = performance.now();
    this.view.draw();
    this.maxPictureTime = Math.max(this.maxPictureTime, performance.now() - before);
    this.drawnAt = now;
    this.drewLast = true;
  }
}

/** Keeps the store's `dark` in step with the colour scheme of the system. */
export function followColourScheme(store: PlayStore): void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const update = () => store.set({ dark: dark.matches });
  dark.addEventListener('change', update);
  update();
}
