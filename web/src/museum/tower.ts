// The tower in the museum: that of 2003, the engine's, or both, with the view and the hand of the game.

import { Vector3 } from 'three';
import { Bodies } from '../bodies';
import { Client } from '../client';
import { Hand } from '../hand';
import { listen } from '../keys';
import { greatest, Lattices } from '../lattice';
import { Notice, trouble } from '../notice';
import { Orbit } from '../orbit';
import { Blend, Rate } from '../pacing';
import { Pointers } from '../pointers';
import { FRAME } from '../protocol';
import { Quality, TIERS } from '../quality';
import type { Options } from '../query';
import { Ring, ringOf } from '../ring';
import { figures, ForceScale, unitOf } from '../scale';
import { Verdict } from '../verdict';
import { View } from '../view';
import { apart } from './apart';
import { Controls } from './controls';
import { Ghost } from './ghost';
import type { TowerInspect } from './inspect';
import type { MuseumFrame, Order, Show } from './protocol';

const FIRST_AZIMUTH = -0.95;
/** Part of the game's distance from the tower. */
const NEARER = 0.86;
/** Time between readouts, s. */
const READOUT = 0.25;

export class Tower {
  private readonly canvas = document.getElementById('picture') as HTMLCanvasElement;
  private readonly orbit = new Orbit(matchMedia('(prefers-reduced-motion: reduce)').matches);
  private readonly view: View;
  private readonly ghostView = new Ghost();
  private readonly quality: Quality;
  private readonly notice = new Notice();
  private readonly ring = new Ring();
  private readonly blend = new Blend(FRAME);
  private readonly pictures = new Rate();
  private readonly lattices = new Lattices();
  private readonly forces = new ForceScale();
  private readonly client: Client<Order, MuseumFrame>;
  private readonly hand: Hand;
  private readonly controls: Controls;
  private readonly pointers: Pointers;
  private bodies: Bodies | null = null;
  private ghost: Bodies | null = null;
  private verdict: Verdict | null = null;
  private last: MuseumFrame | null = null;
  private show: Show = 'old';
  private paused = false;
  private seen = true;
  private watching = false;
  private fell = false;
  private warned: Hand['hold'] = null;
  private resized = true;
  private drewLast = false;
  private drawnAt = 0;
  private readAt = 0;
  private tickedAt = 0;

  /** Throws where the browser has no WebGL 2. */
  constructor(private readonly options: Options) {
    const { canvas, orbit } = this;
    this.view = new View(canvas, orbit, options.scale);
    this.view.add(this.ghostView.group);
    const touch = matchMedia('(hover: none)').matches;
    this.quality = new Quality(options.tier ?? (touch ? 1 : TIERS.length - 1), options.tier !== null);
    this.controls = new Controls(options, {
      build: () => this.build(),
      pause: () => this.setPaused(!this.paused),
      springs: () => this.watch(!this.watching),
      place: () => this.hand.place(),
      turn: () => this.hand.turn(Math.PI / 2),
      letGo: () => this.hand.letGo(),
    });
    this.client = new Client<Order, MuseumFrame>(
      new Worker(new URL('./tower-worker.ts', import.meta.url), { type: 'module' }),
      {
        scenes: () => this.build(),
        built: world => {
          const first = this.bodies === null;
          this.bodies = new Bodies(world.sizes, world.poses, world.place);
          this.ghost = this.show === 'both' ? new Bodies(world.sizes, world.poses.slice(), world.place) : null;
          this.ghostView.hide();
          this.verdict = new Verdict(world.poses);
          this.lattices.arrive(null);
          this.forces.restart();
          this.last = null;
          this.fell = false;
          this.hand.turns = this.show !== 'old';
          this.hand.begin(this.bodies);
          this.view.begin(this.bodies);
          this.frameTower(first ? FIRST_AZIMUTH : undefined);
        },
        frame: frame => this.arrive(frame),
        refused: message => this.notice.say(`This tower cannot be built: ${message}`, 8),
        failed: message => trouble(`The simulation stopped: ${message}. Loading the page again starts anew.`),
      },
    );
    this.hand = new Hand(this.client, orbit, new Bodies(new Float32Array(0), new Float32Array(0)));
    this.hand.cap = options.cap;
    this.pointers = new Pointers(
      canvas,
      this.hand,
      orbit,
      () => this.bodies,
      () => this.frameTower(),
    );
    this.listen();
    this.tickedAt = performance.now() / 1000;
    requestAnimationFrame(() => this.tick());
  }

  /** Whether the tower is on the screen: it stands still while it is not. */
  setSeen(seen: boolean): void {
    if (seen === this.seen) return;
    this.seen = seen;
    this.tellPause();
  }

  setDark(dark: boolean): void {
    this.view.setDark(dark);
    this.ghostView.setDark(dark);
  }

  private build(): void {
    const order = this.controls.order();
    this.hand.letGo();
    this.show = order.show;
    if (this.paused) this.setPaused(false);
    this.client.build(order);
    this.controls.setShow(order.show);
    if (order.show === 'engine') this.watch(false);
  }

  /** Nearer than in the game: no bars lie over the picture. */
  private frameTower(azimuth?: number): void {
    this.orbit.frame(this.bodies?.top() ?? 0.12, azimuth);
    this.orbit.zoom(NEARER);
  }

  private listen(): void {
    const { canvas } = this;
    listen(this.hand, this.orbit, {
      pause: () => this.setPaused(!this.paused),
      frame: () => this.frameTower(),
      mode: () => undefined,
      place: () => this.hand.place(),
      help: () => undefined,
      springs: () => this.watch(!this.watching),
      // Keys belong to the page unless the tower has the focus.
      busy: () => document.activeElement !== canvas,
    });
    canvas.addEventListener('pointerdown', () => {
      const options = { preventScroll: true, focusVisible: false };
      canvas.focus(options);
    });
    // The wheel scrolls the page; with the control key, or a block in the hand, it is the tower's.
    canvas.parentElement!.addEventListener(
      'wheel',
      event => {
        if (!event.ctrlKey && !event.metaKey && !this.hand.hold) event.stopPropagation();
      },
      { capture: true },
    );
    new ResizeObserver(() => (this.resized = true)).observe(canvas);
    document.addEventListener('visibilitychange', () => this.tellPause());
  }

  private setPaused(paused: boolean): void {
    this.paused = this.hand.frozen = paused;
    this.controls.setPaused(paused);
    this.tellPause();
  }

  private tellPause(): void {
    this.client.pause(this.paused || !this.seen || document.hidden);
  }

  private watch(watching: boolean): void {
    this.watching = watching && this.show === 'old';
    this.controls.setSprings(this.watching);
    this.view.invalidate();
  }

  private arrive(frame: MuseumFrame): void {
    const { bodies, verdict } = this;
    if (!bodies || !verdict) return;
    bodies.arrive(frame.poses, frame.lattices);
    this.lattices.arrive(frame.lattices);
    if (frame.ghost) this.ghost?.arrive(frame.ghost.poses, frame.ghost.lattices);
    this.blend.arrive(performance.now() / 1000);
    this.last = frame;
    this.hand.arrive(frame);
    this.warn();
    const held = this.hand.hold?.body ?? this.hand.poking;
    const fell = verdict.judge(frame.poses, frame.time, frame.maxSpeed, held) === 'fallen';
    if (fell && !this.fell) this.notice.say(this.show === 'both' ? 'The engine’s tower fell.' : 'The tower fell.', 6);
    this.fell = fell;
  }

  /** Says once why a carried block has no place on top. */
  private warn(): void {
    const { hold, slots, turns } = this.hand;
    if (turns || hold?.grip !== 'carry' || hold === this.warned || slots.length > 0) return;
    this.warned = hold;
    this.notice.say('This one lies across the places on top, and the hand of 2003 cannot turn it.', 6);
  }

  private fit(): void {
    this.resized = false;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.orbit.resize(width, height);
    this.hand.resize(width, height);
    this.view.resize(width, height, this.quality.tier);
    if (this.bodies && this.drawnAt === 0) this.frameTower(FIRST_AZIMUTH);
  }

  private tick(): void {
    requestAnimationFrame(() => this.tick());
    const now = performance.now() / 1000;
    const since = now - this.tickedAt;
    this.tickedAt = now;
    if (!this.seen) return;
    this.pictures.add(now);
    if (this.drewLast && this.quality.judge(since)) this.resized = true;
    this.drewLast = false;
    if (this.resized) this.fit();
    const { bodies, hand, orbit, view } = this;
    if (!bodies) return;
    if (hand.hold && !hand.frozen) orbit.halt();
    const moved = orbit.update(Math.min(since, 0.1));
    const change = bodies.blend(this.blend.at(now));
    const tensed = this.lattices.blend(this.blend.at(now)) && this.watching;
    const inside = this.watching ? this.lattices.shown : null;
    if (inside) this.forces.follow(greatest(inside), since);
    view.showSprings(inside, this.forces.end);
    const haunted = this.haunt(now);
    const marked = view.marks.show(bodies, {
      hovered: this.pointers.active ? null : this.pointers.hovered,
      held: hand.hold?.body ?? hand.poking,
      selected: hand.selected,
      holders: hand.holders()?.bodies ?? [],
      slots: hand.slots,
      chosen: hand.hold?.slot ?? null,
      slotSize: hand.hold ? bodies.size(hand.hold.body) : null,
    });
    this.showRing(bodies);
    if (now - this.readAt > READOUT) {
      this.readAt = now;
      this.read();
    }
    if (this.options.render === 'once' && now - this.drawnAt < 1) return;
    if (!view.follow(bodies, change) && !moved && !marked && !tensed && !haunted && this.drawnAt > 0) return;
    view.draw();
    this.drawnAt = now;
    this.drewLast = true;
  }

  /** In the air the hand of 2003 has no force, and that is said in its place. */
  private showRing(bodies: Bodies): void {
    const told = this.last?.hand ?? null;
    const state = ringOf(this.hand, told, bodies, this.orbit, this.canvas);
    const writes = this.show === 'old' && told !== null && told.force.every(f => f === 0);
    this.ring.show(state && writes ? { ...state, note: 'its velocity is written' } : state);
  }

  /** Moves the ghost; whether the picture changes. */
  private haunt(now: number): boolean {
    const { bodies, ghost } = this;
    if (!bodies || !ghost || !this.last?.ghost) return false;
    const changed = ghost.blend(this.blend.at(now)) > 1e-5;
    const shown = this.ghostView.group.visible;
    if (changed || !shown) this.ghostView.show(ghost, apart(bodies.shown, ghost.shown).each);
    return changed || !shown;
  }

  private read(): void {
    const { last, controls, bodies } = this;
    controls.setPlaceable(this.hand.canPlace(), this.hand.hold !== null, this.hand.hold?.grip === 'carry');
    if (!last || !bodies) return;
    controls.read({
      frame: last,
      fps: this.pictures.perSecond(),
      apart: last.ghost && apart(last.poses, last.ghost.poses),
      blocks: bodies.count,
      springs: this.watching
        ? `up to ${figures(this.forces.end, unitOf(this.forces.end))} ${unitOf(this.forces.end)}`
        : '',
    });
  }

  readonly inspect: TowerInspect = ((tower: Tower): TowerInspect => ({
    get ready() {
      return tower.last !== null && tower.drawnAt > 0;
    },
    get show() {
      return tower.show;
    },
    get time() {
      return tower.last?.time ?? 0;
    },
    get count() {
      return tower.bodies?.count ?? 0;
    },
    get poses() {
      return Array.from(tower.bodies?.newest ?? []);
    },
    get ghost() {
      return tower.last?.ghost ? Array.from(tower.last.ghost.poses) : null;
    },
    get sizes() {
      return Array.from(tower.bodies?.sizes ?? []);
    },
    get hand() {
      const hold = tower.hand.hold;
      return hold && { body: hold.body, grip: hold.grip };
    },
    get costs() {
      return tower.last?.costs ?? null;
    },
    get springs() {
      return tower.view.springsShown;
    },
    screenOf(body, local = [0, 0, 0]) {
      const point = tower.bodies!.surface(body, new Vector3(...local), tower.bodies!.newest);
      return tower.orbit.project(point, tower.canvas.clientWidth, tower.canvas.clientHeight);
    },
    blockAt: (x, y) => tower.pointers.pickAt(x, y)?.body ?? null,
  }))(this);
}
