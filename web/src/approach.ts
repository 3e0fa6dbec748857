// The way of a carried block to its slot: up, over, down. The block is led, never the pose set: each stage looks at where it is.

import { Quaternion, Vector3 } from 'three';
import { nearestAlike } from './boxes';
import type { Slot } from './slots';

/** Height above the slot at which a block waits to be let go, m. */
export const HOVER = 0.0015;
/** How far below the slot the hand goes to set the block down, m: contact stops it. */
const PRESS = 0.002;
/** Offset (m) and turn (rad) within which a block is lowered, and within which it stays on its way down. */
const OVER = { begin: 0.0008, keep: 0.003 };
const STRAIGHT = { begin: 0.015, keep: 0.06 };
/** Offset beyond which a block rises before it crosses, m. */
const BESIDE = 0.012;
/** How much lower than the crossing a block may be and still cross, m. */
const SAG = 0.005;

export interface Waypoint {
  /** Where the centre is wanted, m. */
  centre: Vector3;
  orientation: Quaternion;
  stage: 'rise' | 'cross' | 'lower';
  /** Largest speed of the hand, m/s. */
  speed: number;
}

/** Next place for a block at `centre` with `turn` on its way to `slot`; `setDown` goes on until it touches. */
export function approach(centre: Vector3, turn: Quaternion, slot: Slot, setDown: boolean): Waypoint {
  const orientation = nearestAlike(slot.orientation, turn);
  const offset = Math.hypot(centre.x - slot.position.x, centre.y - slot.position.y);
  const height = slot.position.z + slot.clearance;
  if (offset > BESIDE && centre.z < height - SAG) {
    return { centre: new Vector3(centre.x, centre.y, height), orientation, stage: 'rise', speed: 0.3 };
  }
  const limit = centre.z < height - SAG ? 'keep' : 'begin';
  if (offset > OVER[limit] || orientation.angleTo(turn) > STRAIGHT[limit]) {
    return { centre: slot.position.clone().setZ(height), orientation, stage: 'cross', speed: 0.3 };
  }
  const drop = setDown ? -PRESS : HOVER;
  return { centre: slot.position.clone().setZ(slot.position.z + drop), orientation, stage: 'lower', speed: 0.04 };
}
