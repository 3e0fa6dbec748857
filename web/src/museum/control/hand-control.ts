// The hand: applies commands, and derives from them the target of each step.

import { Quaternion, Vector3 } from 'three';
import { sameSlot, type GameCommand, type GameEvent, type Grip, type HandUpdate } from '../../engine/game-protocol';
import type { Quat, SlotId, StepReport, Vec } from '../../engine/game-protocol';
import type { Bodies } from '../../view/bodies';
import { isFree } from './free-block';
import { graspedPoint } from './grasped-point';
import * as limits from './hold';
import type { Hold } from './hold';
import { levelled, nearestSymmetric } from './orientations';
import { waypoint } from './placement-path';
import type { HandTarget, Simulator } from './simulator';
import { topSlots, type FreeSlot } from './slots';
import { TargetLimiter, type Goal } from './target-limiter';
import { pullDirection } from './pull-direction';
import { columnBelow, isClear, keepClear } from './tower-clearance';
import { length } from './vectors';

const UP = new Vector3(0, 0, 1);
/** Distance from a block's own position from which a slot counts as another one, m. */
const ELSEWHERE = 0.012;

type Of<C extends GameCommand['command']> = Extract<GameCommand, { command: C }>;

export class HandControl {
  hold: Hold | null = null;
  /** Free slots for the carried block. */
  slots: FreeSlot[] = [];
  private maxForce = 4;
  private careful = false;
  private canTurn = true;
  private towardViewer = new Vector3(0, -1, 0);
  private time = 0;

  constructor(
    private readonly simulator: Simulator,
    private readonly bodies: Bodies,
  ) {}

  /** Applies a command; returns the reason if it is refused. */
  apply(command: GameCommand, events: GameEvent[]): string | null {
    switch (command.command) {
      case 'grasp':
        return this.grasp(command);
      case 'move':
        return this.move(command);
      case 'turn':
        return this.turn(new Quaternion(...command.rotation));
      case 'place':
        return this.place(command);
      case 'poke':
        return this.poke(events);
      case 'release':
        if (!this.hold) return 'the hand holds no block';
        this.end(events, { event: 'released', body: this.hold.body });
        return null;
      case 'set_hand':
        this.maxForce = command.max_force ?? this.maxForce;
        this.careful = command.careful ?? this.careful;
        this.canTurn = command.can_turn ?? this.canTurn;
        return null;
      default:
        return null;
    }
  }

  /** Advances the target by `dt` seconds and returns it. */
  advance(dt: number): HandTarget | null {
    const hold = this.hold;
    if (!hold) return null;
    const anchor = hold.anchor.toArray() as Vec;
    const { point, orientation } = graspedPoint(this.simulator.poses(), hold.body, anchor);
    hold.limiter ??= new TargetLimiter(point, orientation);
    const goal = this.goal(hold);
    const limited = this.simulator.handStiffness === null;
    hold.limiter.advance(goal, point, limited && length(hold.force) > limits.SATURATED * this.maxForce, dt);
    return {
      body: hold.body,
      anchor,
      target: hold.limiter.target(),
      orientation: goal.orientation ? hold.limiter.orientation() : null,
      grip: hold.grip,
      axis: hold.axis.toArray() as Vec,
      max_force: this.maxForce,
      max_torque: limits.TORQUE,
    };
  }

  /** Takes the result of a step. */
  observe(report: StepReport, events: GameEvent[]): void {
    const dt = report.time - this.time;
    this.time = report.time;
    const hold = this.hold;
    if (!hold) return;
    const point = new Vector3(
      ...(report.hand?.point ?? graspedPoint(this.simulator.poses(), hold.body, hold.anchor.toArray() as Vec).point),
    );
    hold.force = report.hand?.force ?? [0, 0, 0];
    hold.capped = length(hold.force) > limits.CAPPED * this.maxForce;
    hold.stuckFor = hold.capped && point.distanceTo(hold.point) < limits.STUCK ? hold.stuckFor + dt : 0;
    hold.point = point;
    hold.contacts = this.simulator.contacts(hold.body);
    if (hold.poking) {
      if (this.time - hold.since >= limits.POKE.seconds) this.end(events, { event: 'poked', body: hold.body });
      return;
    }
    this.regrip(hold);
    this.slots = hold.grip === 'carry' ? this.slotsFor(hold.body) : [];
    if (hold.grip === 'carry' && !hold.placing) this.followSlot(hold);
    if (hold.placing) this.watchPlacing(hold, events);
  }

  update(): HandUpdate | null {
    const { hold } = this;
    return (
      hold && {
        body: hold.body,
        grip: hold.grip,
        mode: hold.mode,
        anchor: hold.anchor.toArray() as Vec,
        axes: this.axes(hold).map(axis => axis.toArray() as Vec),
        force: hold.force,
        capped: hold.capped,
        point: hold.point.toArray() as Vec,
        target: hold.limiter?.target() ?? (hold.goal.toArray() as Vec),
        goal: hold.goal.toArray() as Vec,
        orientation: hold.orientation ? (hold.orientation.toArray() as Quat) : null,
        placing: hold.placing,
        poking: hold.poking,
        slot: hold.slot && { row: hold.slot.row, cell: hold.slot.cell },
        stuck_s: hold.stuckFor,
        contacts: hold.contacts,
      }
    );
  }

  /** Returns true if the block is free and there is a slot to place it in. */
  canPlace(body: number): boolean {
    return isFree(this.bodies, body) && this.otherSlots(body).length > 0;
  }

  /** Directions in which the goal can be moved; none where it can go anywhere. */
  private axes(hold: Hold): Vector3[] {
    if (hold.grip === 'carry') return [];
    if (hold.grip === 'push') return [hold.axis];
    const along = pullDirection(this.bodies.rotation(hold.body, this.bodies.newest));
    return [along, UP.clone().cross(along).normalize()];
  }

  private grasp({ body, anchor, normal, grip: mode }: Of<'grasp'>): string | null {
    if (!(body < this.bodies.count)) return `there is no body ${body}`;
    const auto = isFree(this.bodies, body) ? 'carry' : 'slide';
    const axis = new Vector3(...normal).negate();
    this.take(body, new Vector3(...anchor), axis, mode === 'auto' ? auto : mode).mode = mode;
    return null;
  }

  private take(body: number, anchor: Vector3, axis: Vector3, grip: Grip): Hold {
    const point = this.bodies.toWorld(body, anchor, this.bodies.newest);
    const hold: Hold = {
      body,
      anchor,
      axis,
      mode: 'auto',
      grip,
      goal: point.clone(),
      start: point.clone(),
      orientation: grip === 'push' ? null : this.bodies.rotation(body, this.bodies.newest),
      clear: false,
      slot: null,
      placing: false,
      poking: false,
      since: this.time,
      limiter: null,
      point,
      force: [0, 0, 0],
      capped: false,
      contacts: [],
      stuckFor: 0,
    };
    if (grip === 'carry') this.level(hold);
    this.hold = hold;
    return hold;
  }

  private move({ displacement, slot, toward_viewer }: Of<'move'>): string | null {
    const hold = this.hold;
    if (!hold || hold.placing || hold.poking) return 'the hand holds no block';
    if (toward_viewer) this.towardViewer.set(...toward_viewer, 0).normalize();
    hold.goal.add(new Vector3(...displacement));
    if (hold.grip === 'carry') {
      this.keepAboveTable(hold);
      hold.slot = this.find(slot);
    } else {
      const stretch = hold.goal.clone().sub(hold.point);
      if (stretch.length() > limits.STRETCH) hold.goal.copy(hold.point).add(stretch.setLength(limits.STRETCH));
    }
    return null;
  }

  /** Rotates a carried block about its centre; the grasped point moves with it. */
  private turn(rotation: Quaternion): string | null {
    const hold = this.hold;
    if (!this.canTurn) return 'the hand cannot turn a block';
    if (!hold?.orientation || hold.placing || hold.grip !== 'carry') return 'the hand carries no block';
    const centre = hold.goal.clone().sub(hold.anchor.clone().applyQuaternion(hold.orientation));
    hold.orientation = rotation.multiply(hold.orientation).normalize();
    hold.goal.copy(centre.add(hold.anchor.clone().applyQuaternion(hold.orientation)));
    return null;
  }

  private place({ body: named, slot: id }: Of<'place'>): string | null {
    const body = this.hold?.body ?? named;
    if (body === null || this.hold?.placing || this.hold?.poking) return 'there is no block to place';
    const carried = this.hold?.grip === 'carry';
    if (!carried && !isFree(this.bodies, body)) return `block ${body} is not free`;
    const centre = this.bodies.position(body, this.bodies.newest);
    const nearest = this.otherSlots(body).sort(
      (a, b) => a.position.distanceTo(centre) - b.position.distanceTo(centre),
    )[0];
    const slot = (id && this.slotsFor(body).find(s => sameSlot(s, id))) ?? this.hold?.slot ?? nearest;
    if (!slot) return 'there is no free slot';
    const hold = this.hold ?? this.take(body, new Vector3(), new Vector3(), 'carry');
    hold.grip = 'carry';
    hold.placing = true;
    hold.slot = slot;
    hold.since = this.time;
    return null;
  }

  private poke(events: GameEvent[]): string | null {
    const hold = this.hold;
    if (!hold || hold.placing) return 'the hand holds no block';
    const moved = hold.goal.distanceTo(hold.start) >= limits.UNMOVED;
    if (moved || hold.mode === 'carry' || Math.abs(hold.axis.z) >= limits.UPRIGHT) {
      this.end(events, { event: 'released', body: hold.body });
      return null;
    }
    hold.grip = 'push';
    hold.orientation = null;
    hold.goal = hold.point.clone().addScaledVector(hold.axis, limits.POKE.depth);
    hold.poking = true;
    hold.since = this.time;
    this.slots = [];
    return null;
  }

  private end(events: GameEvent[], event: GameEvent): void {
    this.hold = null;
    this.slots = [];
    events.push(event);
  }

  /**
   * In automatic mode a block that has come out of the tower is carried, and one that is put back
   * is slid.
   */
  private regrip(hold: Hold): void {
    if (hold.mode !== 'auto' || hold.placing || hold.grip === 'push') return;
    const free = isFree(this.bodies, hold.body);
    if (hold.grip === 'slide' && free) {
      hold.grip = 'carry';
      hold.goal.copy(hold.point);
      hold.clear = true;
      this.level(hold);
    } else if (hold.grip === 'carry' && !free && !hold.slot) {
      hold.grip = 'slide';
      hold.goal.copy(hold.point);
    }
  }

  private level(hold: Hold): void {
    const current = hold.orientation ?? this.bodies.rotation(hold.body, this.bodies.newest);
    hold.orientation = levelled(current, limits.LEVELLING);
  }

  private followSlot(hold: Hold): void {
    hold.slot = this.find(hold.slot);
    const column = columnBelow(this.slots, this.bodies.size(hold.body));
    if (column && isClear(this.bodies.position(hold.body, this.bodies.newest), column)) hold.clear = true;
  }

  private find(id: SlotId | null): FreeSlot | null {
    return this.slots.find(slot => sameSlot(slot, id)) ?? null;
  }

  private slotsFor(body: number): FreeSlot[] {
    const slots = topSlots(this.bodies, body, this.bodies.size(body));
    if (this.canTurn) return slots;
    const rotation = this.bodies.rotation(body, this.bodies.newest);
    return slots
      .filter(s => nearestSymmetric(s.orientation, rotation).angleTo(rotation) < limits.ALIGNED)
      .map(s => ({ ...s, orientation: rotation }));
  }

  /** Slots other than the one in which the block lies. */
  private otherSlots(body: number): FreeSlot[] {
    const centre = this.bodies.position(body, this.bodies.newest);
    return this.slotsFor(body).filter(s => s.position.distanceTo(centre) > ELSEWHERE);
  }

  /** Releases the block when it stands in its slot, or when it does not come down. */
  private watchPlacing(hold: Hold, events: GameEvent[]): void {
    const slot = hold.slot!;
    const { stage } = this.waypoint(hold, slot);
    const support = hold.contacts.reduce((sum, c) => sum + Math.max(0, c.normal[2]) * c.force, 0);
    const height = this.bodies.position(hold.body, this.bodies.newest).z - slot.position.z;
    if (stage === 'lower' && support > limits.SUPPORT && height < limits.STANDING)
      this.end(events, { event: 'placed', body: hold.body, slot: { row: slot.row, cell: slot.cell } });
    else if (this.time - hold.since > limits.PATIENCE) this.end(events, { event: 'released', body: hold.body });
  }

  private waypoint(hold: Hold, slot: FreeSlot) {
    const { bodies } = this;
    const centre = bodies.position(hold.body, bodies.newest);
    return waypoint(centre, bodies.rotation(hold.body, bodies.newest), slot, hold.placing);
  }

  /**
   * Goal of the limiter: that of the player, the next waypoint to a slot, or a position clear of
   * the tower.
   */
  goal(hold: Hold): Goal {
    const { handStiffness } = this.simulator;
    const grip = hold.grip;
    const goal: Goal = {
      target: hold.goal.toArray() as Vec,
      orientation: hold.orientation ? (hold.orientation.toArray() as Quat) : null,
      speed: hold.poking ? limits.SPEED.poke : this.careful ? limits.SPEED.careful : limits.SPEED[grip],
      lead: handStiffness !== null && grip !== 'carry' ? this.maxForce / handStiffness : limits.LEAD[grip],
    };
    if (grip === 'carry' && hold.slot) {
      const next = this.waypoint(hold, hold.slot);
      goal.target = next.centre.add(hold.anchor.clone().applyQuaternion(next.orientation)).toArray() as Vec;
      goal.orientation = next.orientation.toArray() as Quat;
      goal.speed = hold.placing ? next.speed : Math.min(goal.speed, next.speed);
    } else if (grip === 'carry' && hold.clear && hold.mode === 'auto') {
      goal.target = this.clearGoal(hold).toArray() as Vec;
    }
    return goal;
  }

  private clearGoal(hold: Hold): Vector3 {
    const column = columnBelow(this.slots, this.bodies.size(hold.body));
    if (!column) return hold.goal;
    const arm = hold.anchor.clone().applyQuaternion(hold.orientation!);
    const current = this.bodies.position(hold.body, this.bodies.newest);
    return keepClear(hold.goal.clone().sub(arm), current, this.towardViewer, column).add(arm);
  }

  private keepAboveTable(hold: Hold): void {
    const arm = hold.anchor.clone().applyQuaternion(hold.orientation!);
    const lowest = hold.goal.z - arm.z - this.bodies.halfExtent(hold.body, UP, this.bodies.newest);
    if (lowest < 0) hold.goal.z -= lowest;
  }
}
