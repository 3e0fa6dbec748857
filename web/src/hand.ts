// The hand: from pointer, keys and buttons to what the worker is asked for. It never moves a block; it wishes.

import { Quaternion, Vector3 } from 'three';
import { approach } from './approach';
import type { Bodies } from './bodies';
import { drawn, isFree, levelled, nearestAlike, type Hit } from './boxes';
import { axisWay, slideWay, type Lever } from './drag';
import { columnUnder, isClear, keepClear } from './guard';
import type { Orbit } from './orbit';
import type { Contact, Frame, Grip, Wish } from './protocol';
import { topSlots, type Slot } from './slots';

export type Mode = 'auto' | 'pull' | 'push' | 'carry';

const UP = new Vector3(0, 0, 1);
/** Torque of the hand, N m: holds a block level by its end. */
const TORQUE = 0.02;
/** Largest speeds of the target, m/s: a quick and a careful hand. */
const SPEED = { slide: 0.25, carry: 0.5, push: 0.12 };
const CAREFUL_SPEED = 0.03;
/** How far the target may be ahead of the grasped point, m; where the force is at its cap it goes no farther ahead. */
const LEAD = { slide: 0.012, carry: 0.03, push: 0.012 };
/** Part of the cap from which the hand counts as giving all it has. */
const ALL = 0.97;
/** How far the wish may be ahead of the grasped point, m: turning back is felt at once. */
const STRETCH = 0.06;
/** A poke: how far the fingertip goes, how fast, for how long. */
const POKE = { depth: 0.006, speed: 0.04, seconds: 0.35 };
/** Distance on the screen, in metres at the slot's depth, at which a slot draws the hand. */
const DRAW = 0.03;
/** Way of the hand up to which a tap is a poke, m. */
const FRESH = 0.004;
/** Height above its slot below which a block that touches stands in it, m: more would be the edge of a neighbour. */
const STANDING = 0.002;
/** Turn out of a place, rad, up to which a hand that cannot turn a block lays it there. */
const ALONG = 0.2;
/** Time after which a block that does not come down is let go, s. */
const PATIENCE = 6;

/** Who is told what the hand wants. */
export interface Wisher {
  hand(wish: Wish | null): void;
}

interface Hold {
  body: number;
  anchor: Vector3;
  grip: Grip;
  /** Where the grasped point is wanted, m. */
  wish: Vector3;
  orientation: Quaternion | null;
  /** Inward normal of the face that was touched. */
  axis: Vector3;
  /** Where the grasped point was when it was grasped, m. */
  start: Vector3;
  /** Whether slots may draw it: not before it has left the one it was in. */
  drawn: boolean;
  /** Whether it has come clear of the tower, beside or above it, and is to be kept clear. */
  clear: boolean;
  slot: Slot | null;
  /** Whether the hand is setting it down by itself. */
  placing: boolean;
  /** Simulated time at which placing began, s. */
  since: number;
  /** Grasped point, force and contacts as the worker last told. */
  point: Vector3;
  force: number;
  capped: boolean;
  contacts: Contact[];
  stuckFor: number;
}

export class Hand {
  mode: Mode = 'auto';
  /** Largest force, N. */
  cap = 4;
  careful = false;
  /** Whether it can turn what it carries. One that cannot takes only places where a block lies as it does already. */
  turns = true;
  /** Time stands still: the block stays held, and the pointer turns the camera. */
  frozen = false;
  hold: Hold | null = null;
  poking: number | null = null;
  selected: number | null = null;
  slots: Slot[] = [];
  private viewport = { width: 1, height: 1 };
  private time = 0;

  constructor(
    private readonly client: Wisher,
    private readonly orbit: Orbit,
    private bodies: Bodies,
  ) {}

  begin(bodies: Bodies): void {
    this.bodies = bodies;
    this.hold = null;
    this.poking = null;
    this.selected = null;
    this.slots = [];
  }

  resize(width: number, height: number): void {
    this.viewport = { width, height };
  }

  /** Grasps a block at the point that was hit. */
  press(hit: Hit): void {
    this.selected = hit.body;
    this.poking = null;
    this.grasp(hit.body, hit.anchor, hit.normal.clone().negate(), this.gripFor(hit.body));
    this.tell();
  }

  /** Follows the pointer by (dx, dy) pixels. */
  drag(dx: number, dy: number): void {
    const hold = this.hold;
    if (!hold || this.frozen || hold.placing) return;
    const scale = this.orbit.scaleAt(hold.wish, this.viewport.height);
    if (hold.grip === 'carry') {
      const { right, up, gain } = this.carryPlane();
      hold.wish.addScaledVector(right, dx / scale).addScaledVector(up, (-dy * gain) / scale);
      this.keepAboveTable(hold);
    } else if (hold.grip === 'push') {
      hold.wish.addScaledVector(hold.axis, axisWay(dx, dy, this.lever(hold.wish, hold.axis), scale));
    } else {
      const along = drawn(this.bodies.turn(hold.body, this.bodies.newest));
      const across = UP.clone().cross(along).normalize();
      const way = slideWay(dx, dy, this.lever(hold.wish, along), this.lever(hold.wish, across), scale);
      hold.wish.addScaledVector(along, way.along).addScaledVector(across, way.across);
    }
    if (hold.grip !== 'carry') {
      const stretch = hold.wish.clone().sub(hold.point);
      if (stretch.length() > STRETCH) hold.wish.copy(hold.point).add(stretch.setLength(STRETCH));
    }
    this.tell();
  }

  /** Moves a carried block away from the viewer, m. */
  depth(way: number): void {
    const hold = this.hold;
    if (!hold || this.frozen || hold.placing || hold.grip !== 'carry') return;
    hold.wish.addScaledVector(this.orbit.forward().setZ(0).normalize(), way);
    this.tell();
  }

  /** Turns a carried block about the vertical, rad. */
  turn(angle: number): void {
    this.rotate(new Quaternion().setFromAxisAngle(UP, angle));
  }

  /** Tips a carried block a quarter over its long axis. */
  tip(): void {
    if (this.hold) this.rotate(new Quaternion().setFromAxisAngle(this.longAxis(this.hold.body), Math.PI / 2));
  }

  /** The pointer left the block. `tap`: it came and went without moving. */
  release(tap: boolean): void {
    const hold = this.hold;
    if (!hold || this.frozen || hold.placing) return;
    // A block that was moved before, as in a pause, is not poked.
    const fresh = hold.wish.distanceTo(hold.start) < FRESH;
    if (tap && fresh && this.mode !== 'carry' && Math.abs(hold.axis.z) < 0.5) return this.poke(hold);
    if (!tap && hold.slot) return this.setDown(hold, hold.slot);
    this.letGo();
  }

  letGo(): void {
    this.hold = null;
    this.poking = null;
    this.slots = [];
    this.client.hand(null);
  }

  /** Whether there is a block that could be put on top now. */
  canPlace(): boolean {
    const body = this.hold?.body ?? this.selected;
    if (body === null || this.hold?.placing) return false;
    return (this.hold?.grip === 'carry' || isFree(this.bodies, body)) && this.freeSlots(body).length > 0;
  }

  /** Puts the held or the selected block on top by itself. */
  place(): void {
    if (!this.canPlace() || this.frozen) return;
    const body = this.hold?.body ?? this.selected!;
    if (!this.hold) this.grasp(body, new Vector3(), new Vector3(), 'carry');
    const hold = this.hold!;
    hold.grip = 'carry';
    const centre = this.bodies.position(body);
    const slots = this.freeSlots(body);
    slots.sort((a, b) => a.position.distanceTo(centre) - b.position.distanceTo(centre));
    this.setDown(hold, hold.slot ?? slots[0]);
  }

  /** Takes in what the worker tells. */
  arrive(frame: Frame): void {
    const dt = frame.time - this.time;
    this.time = frame.time;
    if (frame.handDone) this.poking = null;
    const hold = this.hold;
    if (!hold || frame.hand?.body !== hold.body) return;
    const point = new Vector3(...frame.hand.point);
    const force = Math.hypot(...frame.hand.force);
    const capped = force > ALL * this.cap;
    hold.stuckFor = capped && point.distanceTo(hold.point) < 2e-5 ? hold.stuckFor + dt : 0;
    hold.point = point;
    hold.force = force;
    hold.capped = capped;
    hold.contacts = frame.hand.contacts;
    this.regrip(hold);
    if (hold.grip === 'carry') this.seekSlot(hold);
    if (hold.placing) this.watchPlacing(hold);
    if (this.hold) this.tell();
  }

  /** The blocks that hold a block which will not move, by falling force. */
  holders(): { bodies: number[]; force: number } | null {
    const hold = this.hold;
    if (!hold || hold.grip === 'carry' || hold.stuckFor < 0.15) return null;
    return holding(hold.contacts);
  }

  private poke(hold: Hold): void {
    const target = hold.point.clone().addScaledVector(hold.axis, POKE.depth);
    this.poking = hold.body;
    this.hold = null;
    this.client.hand({
      body: hold.body,
      anchor: hold.anchor.toArray(),
      target: target.toArray(),
      orientation: null,
      grip: 'push',
      axis: hold.axis.toArray(),
      maxForce: this.cap,
      maxTorque: TORQUE,
      speed: POKE.speed,
      lead: LEAD.push,
      seconds: POKE.seconds,
    });
  }

  private grasp(body: number, anchor: Vector3, axis: Vector3, grip: Grip): void {
    const point = this.bodies.toWorld(body, anchor, this.bodies.newest);
    this.hold = {
      body,
      anchor,
      grip,
      wish: point.clone(),
      orientation: grip === 'push' ? null : this.bodies.turn(body, this.bodies.newest),
      axis,
      start: point.clone(),
      drawn: false,
      clear: false,
      slot: null,
      placing: false,
      since: this.time,
      point,
      force: 0,
      capped: false,
      contacts: [],
      stuckFor: 0,
    };
    if (grip === 'carry') this.startCarry(this.hold);
  }

  private gripFor(body: number): Grip {
    if (this.mode === 'push') return 'push';
    if (this.mode === 'carry') return 'carry';
    if (this.mode === 'pull') return 'slide';
    return isFree(this.bodies, body) ? 'carry' : 'slide';
  }

  /** A block that has come out of the tower is carried; one that is put back into it is slid. */
  private regrip(hold: Hold): void {
    if (this.mode !== 'auto' || hold.placing || hold.grip === 'push') return;
    const free = isFree(this.bodies, hold.body);
    if (hold.grip === 'slide' && free) {
      hold.grip = 'carry';
      hold.wish.copy(hold.point);
      hold.clear = true;
      this.startCarry(hold);
    } else if (hold.grip === 'carry' && !free && !hold.slot) {
      hold.grip = 'slide';
      hold.wish.copy(hold.point);
    }
  }

  private startCarry(hold: Hold): void {
    hold.orientation = levelled(hold.orientation ?? this.bodies.turn(hold.body, this.bodies.newest), 0.3);
    hold.drawn = false;
  }

  private rotate(by: Quaternion): void {
    const hold = this.hold;
    if (!this.turns || !hold?.orientation || this.frozen || hold.placing || hold.grip !== 'carry') return;
    // About the block's centre: the grasped point goes round with it.
    const centre = hold.wish.clone().sub(hold.anchor.clone().applyQuaternion(hold.orientation));
    hold.orientation = by.multiply(hold.orientation).normalize();
    hold.wish.copy(centre.add(hold.anchor.clone().applyQuaternion(hold.orientation)));
    this.tell();
  }

  private freeSlots(body: number): Slot[] {
    const centre = this.bodies.position(body, this.bodies.newest);
    return this.slotsFor(body).filter(s => s.position.distanceTo(centre) > 0.012);
  }

  private slotsFor(body: number): Slot[] {
    const slots = topSlots(this.bodies, body, this.bodies.size(body));
    if (this.turns) return slots;
    const turn = this.bodies.turn(body, this.bodies.newest);
    const alike = slots.filter(s => nearestAlike(s.orientation, turn).angleTo(turn) < ALONG);
    return alike.map(s => ({ ...s, orientation: turn }));
  }

  /** The slot that draws the carried block: the nearest on the screen, held a little longer than it is taken. */
  private seekSlot(hold: Hold): void {
    this.slots = this.slotsFor(hold.body);
    if (hold.placing) return;
    const column = columnUnder(this.slots, this.bodies.size(hold.body));
    if (column && isClear(this.bodies.position(hold.body, this.bodies.newest), column)) hold.clear = true;
    const { width, height } = this.viewport;
    const centre = hold.wish.clone().sub(hold.anchor.clone().applyQuaternion(hold.orientation!));
    const here = this.orbit.project(centre, width, height);
    let best: Slot | null = null;
    let least = Infinity;
    for (const slot of this.slots) {
      const there = this.orbit.project(slot.position, width, height);
      const reach = DRAW * this.orbit.scaleAt(slot.position, height);
      const kept = hold.slot !== null && hold.slot.position.distanceTo(slot.position) < 0.005;
      const distance = Math.hypot(there.x - here.x, there.y - here.y) / (Math.max(reach, 22) * (kept ? 1.5 : 1));
      if (distance < least) {
        least = distance;
        best = slot;
      }
    }
    if (!hold.drawn && least > 1.3) hold.drawn = true;
    hold.slot = hold.drawn && least < 1 ? best : null;
  }

  private setDown(hold: Hold, slot: Slot): void {
    hold.placing = true;
    hold.slot = slot;
    hold.since = this.time;
    this.tell();
  }

  /** Lets go when the block stands on something, or when it does not come down. */
  private watchPlacing(hold: Hold): void {
    const { stage } = this.waypoint(hold, hold.slot!);
    const carried = hold.contacts.reduce((sum, c) => sum + Math.max(0, c.normal[2]) * c.force, 0);
    const left = this.bodies.position(hold.body, this.bodies.newest).z - hold.slot!.position.z;
    if ((stage === 'lower' && carried > 0.03 && left < STANDING) || this.time - hold.since > PATIENCE) this.letGo();
  }

  private waypoint(hold: Hold, slot: Slot) {
    const { bodies } = this;
    return approach(
      bodies.position(hold.body, bodies.newest),
      bodies.turn(hold.body, bodies.newest),
      slot,
      hold.placing,
    );
  }

  private tell(): void {
    const hold = this.hold;
    if (!hold) return;
    const speed = hold.grip === 'carry' ? SPEED.carry : SPEED[hold.grip];
    const wish: Wish = {
      body: hold.body,
      anchor: hold.anchor.toArray(),
      target: hold.wish.toArray(),
      orientation: hold.orientation ? (hold.orientation.toArray() as Wish['orientation']) : null,
      grip: hold.grip,
      axis: hold.axis.toArray(),
      maxForce: this.cap,
      maxTorque: TORQUE,
      speed: this.careful ? CAREFUL_SPEED : speed,
      lead: LEAD[hold.grip],
      seconds: null,
    };
    if (hold.grip === 'carry' && hold.slot) {
      const way = this.waypoint(hold, hold.slot);
      wish.target = way.centre.add(hold.anchor.clone().applyQuaternion(way.orientation)).toArray();
      wish.orientation = way.orientation.toArray() as Wish['orientation'];
      wish.speed = hold.placing ? way.speed : Math.min(wish.speed, way.speed);
    } else if (hold.grip === 'carry' && hold.clear && this.mode === 'auto') {
      const arm = hold.anchor.clone().applyQuaternion(hold.orientation!);
      const column = columnUnder(this.slots, this.bodies.size(hold.body));
      const towards = this.orbit.forward().negate().setZ(0).normalize();
      if (column)
        wish.target = keepClear(
          hold.wish.clone().sub(arm),
          this.bodies.position(hold.body, this.bodies.newest),
          towards,
          column,
        )
          .add(arm)
          .toArray();
    }
    this.client.hand(wish);
  }

  private longAxis(body: number): Vector3 {
    const axis = new Vector3(1, 0, 0).applyQuaternion(this.bodies.turn(body, this.bodies.newest)).setZ(0);
    return axis.lengthSq() > 1e-6 ? axis.normalize() : new Vector3(1, 0, 0);
  }

  /** The plane in which a block is carried: upright and facing the viewer, or level where the view is from above. */
  private carryPlane(): { right: Vector3; up: Vector3; gain: number } {
    const forward = this.orbit.forward();
    const flat = forward.clone().setZ(0).normalize();
    const right = flat.clone().cross(UP);
    const steep = this.orbit.elevation > 0.95;
    const up = steep ? flat : UP.clone();
    const gain = 1 / Math.max(0.5, steep ? Math.abs(forward.z) : Math.hypot(forward.x, forward.y));
    return { right, up, gain };
  }

  private keepAboveTable(hold: Hold): void {
    const lowest =
      hold.wish.z -
      hold.anchor.clone().applyQuaternion(hold.orientation!).z -
      this.bodies.halfExtent(hold.body, UP, this.bodies.newest);
    if (lowest < 0) hold.wish.z -= lowest;
  }

  private lever(point: Vector3, direction: Vector3): Lever {
    const { width, height } = this.viewport;
    const step = 0.005;
    const a = this.orbit.project(point, width, height);
    const b = this.orbit.project(point.clone().addScaledVector(direction, step), width, height);
    return {
      screen: { x: (b.x - a.x) / step, y: (b.y - a.y) / step },
      towards: -direction.dot(this.orbit.forward().setZ(0).normalize()),
    };
  }
}

/** The blocks among contacts that press hardest, and the force of them all, N. */
export function holding(contacts: Contact[]): { bodies: number[]; force: number } {
  const blocks = contacts.filter(c => c.other !== null).sort((a, b) => b.force - a.force);
  const strong = blocks.filter(c => c.force > 0.2 * blocks[0].force).slice(0, 4);
  return { bodies: [...new Set(strong.map(c => c.other!))], force: strong.reduce((sum, c) => sum + c.force, 0) };
}
