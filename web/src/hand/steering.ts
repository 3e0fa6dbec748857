// The hand without a pointer: a block is chosen, taken, moved and set down by keys or by a gamepad.

import { Vector3 } from 'three';
import type { PlayStore } from '../app/state';
import { FRAME } from '../engine/game-protocol';
import type { Bodies } from '../view/bodies';
import { outward, visibleFace, type Face } from '../view/faces';
import type { Orbit } from '../view/orbit';
import type { Hand } from './hand';
import { nearest, neighbour } from './neighbour';
import type { ScreenVector } from './screen-to-world';

const UP = new Vector3(0, 0, 1);
/** Speeds of the hand's target, m/s: along a block in the tower, and of a carried one. */
const SPEED = { slide: 0.045, carry: 0.16 };
/** Factor on the speed of a careful hand. */
const CAREFUL = 0.3;

/** Motion that is asked of the hand: each part from -1 to 1. */
export interface Steer {
  /** To the right of the screen. */
  right: number;
  /** Up; in the tower, into it. */
  up: number;
  /** Away from the viewer. */
  away: number;
}

/** Returns what two devices ask for together. */
export function sumOf(a: Steer, b: Steer): Steer {
  return { right: a.right + b.right, up: a.up + b.up, away: a.away + b.away };
}

export class Steering {
  /** Block that is chosen, while blocks are chosen. */
  private chosen: number | null = null;
  /** Direction out of the tower at the face that was taken; null while nothing is. */
  private outward: Vector3 | null = null;

  /** `say` takes the chosen block, to be announced. */
  constructor(
    private readonly store: PlayStore,
    private readonly hand: Hand,
    private readonly orbit: Orbit,
    private readonly bodies: () => Bodies | null,
    private readonly say: (body: number, height: number) => void,
  ) {
    store.subscribe(['world', 'pointing'], ({ pointing }) => {
      if (pointing || (this.chosen ?? 0) >= (this.bodies()?.count ?? 0)) this.end();
    });
  }

  /** True while blocks are chosen or moved without a pointer. */
  get active(): boolean {
    return this.chosen !== null;
  }

  /** True while a block that was taken without a pointer is in the hand. */
  get holds(): boolean {
    return this.outward !== null && this.hand.holds;
  }

  /** Chooses the next block in a direction of the screen; at first the one in the middle. */
  choose(direction: ScreenVector): void {
    const bodies = this.bodies();
    if (!bodies || this.hand.holds) return;
    const seen = Array.from({ length: bodies.count }, (_, body) => this.seen(bodies, body));
    const from = this.chosen === null ? null : (seen[this.chosen] ?? this.orbit.project(bodies.position(this.chosen)));
    const next = from ? neighbour(seen, from, direction) : nearest(seen, this.middle(bodies));
    if (next === null) return;
    this.chosen = next;
    this.store.set({ selected: next, hovered: null });
    this.say(next, bodies.position(next).z);
  }

  /** Takes the chosen block by the face that is seen; returns false where none is. */
  take(): boolean {
    const bodies = this.bodies();
    if (!bodies || this.chosen === null || this.hand.holds || this.store.state.paused) return false;
    const face = visibleFace(bodies, this.orbit, this.chosen);
    if (!face) return false;
    this.press(bodies, this.chosen, face);
    return true;
  }

  /** Pokes the chosen block at the face that is seen. */
  poke(): void {
    if (!this.hand.holds && this.take()) this.hand.release(true);
  }

  /** Moves the block in the hand for one frame. */
  step({ right, up, away }: Steer): void {
    const { held, holds } = this.hand;
    if (!this.holds || !holds || !held) return;
    const careful = this.store.state.careful ? CAREFUL : 1;
    const [along, across] = held.axes.map(axis => new Vector3(...axis));
    const forward = this.orbit.forward().setZ(0).normalize();
    const sideways = forward.clone().cross(UP);
    if (!along) {
      const by = sideways.multiplyScalar(right).addScaledVector(UP, up).addScaledVector(forward, away);
      return this.hand.shift(by.multiplyScalar(SPEED.carry * careful * FRAME));
    }
    const out = along.multiplyScalar(along.dot(this.outward!) < 0 ? -1 : 1);
    const by = out.multiplyScalar(-up - away);
    if (across) by.addScaledVector(across, across.dot(sideways) < 0 ? -right : right);
    this.hand.shift(by.multiplyScalar(SPEED.slide * careful * FRAME));
  }

  /** Ends the choice; a block in the hand stays there. */
  end(): void {
    this.chosen = null;
    if (!this.hand.holds) this.outward = null;
  }

  private press(bodies: Bodies, body: number, { axis, side, middle }: Face): void {
    const normal = outward(bodies, body, axis, side);
    this.outward = normal.clone();
    const point = bodies.surface(body, middle);
    this.hand.press({ body, distance: 0, point, anchor: bodies.toLocal(body, point), normal });
  }

  private seen(bodies: Bodies, body: number): ScreenVector | null {
    const face = visibleFace(bodies, this.orbit, body);
    return face && this.orbit.project(bodies.surface(body, face.middle));
  }

  private middle(bodies: Bodies): ScreenVector {
    return this.orbit.project(new Vector3(0, 0, 0.6 * bodies.top()));
  }
}
