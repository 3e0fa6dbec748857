// States of a gesture. A state turns what the player does into commands, and returns the name of
// the next state where it changes.

import { Vector3 } from 'three';
import type { GameCommand, Grip, HandUpdate, SlotId, Slot, Vec } from '../../engine/game-protocol';
import type { Orbit } from '../../view/orbit';
import { dragDisplacement } from '../drag-displacement';
import type { ScreenVector } from '../screen-to-world';

export type GestureName = 'idle' | 'pressing' | 'sliding' | 'carrying' | 'placing' | 'poking';
export type Transition = GestureName | null;

/** The block of a gesture. */
export interface Grasp {
  body: number;
  /** Sum of the displacements since the grasp, m. */
  displacement: Vector3;
  /** Number of the command that began the present state: updates from before it do not count. */
  command: number;
}

export interface GestureContext {
  readonly orbit: Orbit;
  /** Hand of the last update; null until the grasp has been applied. */
  readonly hand: HandUpdate | null;
  /** Sends a command and returns its number. */
  send(command: GameCommand): number;
}

export interface GestureState {
  readonly name: GestureName;
  /** The pointer moved, px. */
  drag?(drag: ScreenVector): Transition;
  /** The block is moved in the world, m. */
  shift?(displacement: Vector3): Transition;
  /** The pointer left the block; `tap`: it came and went without moving. */
  release?(tap: boolean): Transition;
  /** The hand has been updated. */
  update?(hand: HandUpdate, slots: Slot[]): Transition;
}

export type GestureFactory = (context: GestureContext, grasp: Grasp) => GestureState;

/** Returns the gesture that moves a block held with a grip. */
export function gestureOf(grip: Grip): GestureName {
  return grip === 'carry' ? 'carrying' : 'sliding';
}

export function move(context: GestureContext, displacement: Vector3, slot: SlotId | null = null): void {
  const towards = context.orbit.forward().negate();
  const toward_viewer: [number, number] = [towards.x, towards.y];
  context.send({ command: 'move', displacement: displacement.toArray() as Vec, slot, toward_viewer });
}

/** Moves the block by a drag (px); returns the displacement, m. */
export function follow(
  context: GestureContext,
  grasp: Grasp,
  hand: HandUpdate,
  drag: ScreenVector,
  slot: SlotId | null = null,
): Vector3 {
  const displacement = dragDisplacement(context.orbit, hand, drag);
  grasp.displacement.add(displacement);
  move(context, displacement, slot);
  return displacement;
}

/** Moves the block by a displacement in the world, m. */
export function shiftBy(
  context: GestureContext,
  grasp: Grasp,
  displacement: Vector3,
  slot: SlotId | null = null,
): void {
  grasp.displacement.add(displacement);
  move(context, displacement, slot);
}

export function letGo(context: GestureContext): GestureName {
  context.send({ command: 'release' });
  return 'idle';
}
