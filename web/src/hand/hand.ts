// The player's hand: from pointers, keys and buttons to commands. It never moves a block itself.

import { Quaternion, Vector3 } from 'three';
import type { PlayStore } from '../app/state';
import type { Contact, GameCommand, HandUpdate, Quat, Slot, TimedReport, Vec } from '../engine/game-protocol';
import type { Frame } from '../engine/protocol';
import type { Bodies } from '../view/bodies';
import type { Orbit } from '../view/orbit';
import type { Hit } from '../view/picking';
import { carrying } from './gestures/carrying';
import { gestureOf, move } from './gestures/gesture';
import type { GestureContext, GestureFactory, GestureName, GestureState, Grasp, Transition } from './gestures/gesture';
import { idle } from './gestures/idle';
import { placing } from './gestures/placing';
import { poking } from './gestures/poking';
import { pressing } from './gestures/pressing';
import { sliding } from './gestures/sliding';
import type { ScreenVector } from './screen-to-world';

const UP = new Vector3(0, 0, 1);
/** Simulated time after which a block at full force counts as stuck, s. */
const STUCK = 0.15;

const factories: Record<Exclude<GestureName, 'idle'>, GestureFactory> = {
  pressing,
  sliding,
  carrying,
  placing,
  poking,
};

/** Receives commands; returns the number of each. */
export interface CommandSink {
  command(command: GameCommand): number;
}

export class Hand {
  private state: GestureState = idle;
  private grasp: Grasp | null = null;
  private readonly context: GestureContext;

  /** `bodies`: the blocks of the present world. */
  constructor(
    private readonly sink: CommandSink,
    private readonly store: PlayStore,
    orbit: Orbit,
    private readonly bodies: () => Bodies,
  ) {
    const hand = this;
    this.context = {
      orbit,
      get hand() {
        return hand.held;
      },
      send: command => sink.command(command),
    };
    // Each world begins with a hand of its own, which takes the settings again.
    store.subscribe(['world', 'maxForce', 'careful'], ({ world, maxForce: max_force, careful }) => {
      if (world) sink.command({ command: 'set_hand', max_force, careful });
    });
    store.subscribe(['world'], () => this.reset());
    // The camera may have turned during a pause.
    store.subscribe(['paused'], ({ paused }) => {
      if (!paused && this.carries) move(this.context, new Vector3(), this.held?.slot ?? null);
    });
  }

  get gesture(): GestureName {
    return this.state.name;
  }

  /** Block that the gesture is about. */
  get body(): number | null {
    return this.grasp?.body ?? null;
  }

  /** True while the player moves a block, as opposed to a poke. */
  get holds(): boolean {
    return this.state.name !== 'idle' && this.state.name !== 'poking';
  }

  /**
   * Hand of the last update, also that of another player; null until the command that began the
   * gesture has been applied.
   */
  get held(): HandUpdate | null {
    const { frame, watching } = this.store.state;
    if (watching) return frame?.update.hand ?? null;
    if (!frame || !this.grasp || frame.applied < this.grasp.command) return null;
    return frame.update.hand?.body === this.grasp.body ? frame.update.hand : null;
  }

  /** True while a block is carried by the player. */
  get carries(): boolean {
    return !this.store.state.watching && this.held?.grip === 'carry' && this.gesture !== 'placing';
  }

  /** Free slots for the carried block. */
  get slots(): Slot[] {
    return this.held ? this.store.state.frame!.update.slots : [];
  }

  /** Grasps a block at the point that was hit; nothing while the player only watches. */
  press({ body, anchor, normal }: Hit): void {
    if (this.store.state.watching) return;
    const command = this.sink.command({
      command: 'grasp',
      body,
      anchor: anchor.toArray() as Vec,
      normal: normal.toArray() as Vec,
      grip: this.store.state.grip,
    });
    this.grasp = { body, displacement: new Vector3(), command };
    this.enter('pressing');
    this.store.set({ selected: body });
  }

  /** Takes over a block that the hand of the game holds already. */
  adopt({ body, grip, placing, poking }: HandUpdate): void {
    this.grasp = { body, displacement: new Vector3(), command: 0 };
    this.enter(placing ? 'placing' : poking ? 'poking' : gestureOf(grip));
    this.store.set({ selected: body });
  }

  /** Follows the pointer, px. */
  drag(by: ScreenVector): void {
    if (!this.paused) this.enter(this.state.drag?.(by));
  }

  /** Moves a carried block away from the viewer, m. */
  moveAway(distance: number): void {
    if (this.held?.grip === 'carry')
      this.shift(this.context.orbit.forward().setZ(0).normalize().multiplyScalar(distance));
  }

  /** Moves the block in the world, m; one in the tower only along its axes. */
  shift(displacement: Vector3): void {
    if (!this.paused) this.enter(this.state.shift?.(displacement));
  }

  /** The pointer left the block; `tap`: it came and went without moving. */
  release(tap: boolean): void {
    if (!this.paused) this.enter(this.state.release?.(tap));
  }

  /** Limits the force of the hand, N, until the setting changes. */
  limitForce(max_force: number): void {
    this.sink.command({ command: 'set_hand', max_force });
  }

  /** Turns a carried block about the vertical, rad. */
  turn(angle: number): void {
    this.rotate(new Quaternion().setFromAxisAngle(UP, angle));
  }

  /** Tips a carried block by a quarter turn about its long axis. */
  tip(): void {
    if (this.grasp) this.rotate(new Quaternion().setFromAxisAngle(this.longAxis(this.grasp.body), Math.PI / 2));
  }

  /** Releases the block in any gesture. */
  letGo(): void {
    if (this.grasp) this.sink.command({ command: 'release' });
    this.reset();
  }

  /** Returns true if there is a block that can be placed on top. */
  canPlace(): boolean {
    const { selected, frame, watching } = this.store.state;
    if (watching) return false;
    if (this.gesture === 'placing' || this.gesture === 'poking') return false;
    return selected !== null && (frame?.placeable ?? false);
  }

  /** Places the held or the selected block on top. */
  place(): void {
    if (!this.canPlace() || this.paused) return;
    const body = this.body ?? this.store.state.selected!;
    const slot = this.held?.slot ?? null;
    const command = this.sink.command({ command: 'place', body, slot });
    if (this.grasp) this.grasp.command = command;
    else this.grasp = { body, displacement: new Vector3(), command };
    this.enter('placing');
  }

  /** Takes a frame, which must be in the store already. */
  receive({ applied, update }: Frame<TimedReport>): void {
    if (!this.grasp || applied < this.grasp.command) return;
    if (!update.hand) this.reset();
    else this.enter(this.state.update?.(update.hand, update.slots));
  }

  /** Blocks that hold a block which is stuck, by falling force, and the sum of their forces, N. */
  holders(): Holders | null {
    const { held } = this;
    return held && held.grip !== 'carry' && held.stuck_s >= STUCK ? holdersOf(held.contacts) : null;
  }

  private get paused(): boolean {
    return this.store.state.paused;
  }

  private reset(): void {
    this.grasp = null;
    this.state = idle;
  }

  private enter(name: Transition | undefined): void {
    if (!name) return;
    if (name === 'idle') this.reset();
    else this.state = factories[name](this.context, this.grasp!);
  }

  private rotate(by: Quaternion): void {
    if (this.carries && !this.paused) this.sink.command({ command: 'turn', rotation: by.toArray() as Quat });
  }

  private longAxis(body: number): Vector3 {
    const bodies = this.bodies();
    const axis = new Vector3(1, 0, 0).applyQuaternion(bodies.rotation(body, bodies.newest)).setZ(0);
    return axis.lengthSq() > 1e-6 ? axis.normalize() : new Vector3(1, 0, 0);
  }
}

export interface Holders {
  bodies: number[];
  /** N. */
  force: number;
}

/** Returns the blocks whose contacts press hardest, and the sum of their forces. */
export function holdersOf(contacts: Contact[]): Holders {
  const blocks = contacts.filter(c => c.other !== null).sort((a, b) => b.force - a.force);
  const strong = blocks.filter(c => c.force > 0.2 * blocks[0].force).slice(0, 4);
  return { bodies: [...new Set(strong.map(c => c.other!))], force: strong.reduce((sum, c) => sum + c.force, 0) };
}
