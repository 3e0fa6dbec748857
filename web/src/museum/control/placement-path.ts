// Path of a carried block to its slot: up, across, down. Each stage follows from the position of
// the block; its pose is never set.

import { Quaternion, Vector3 } from 'three';
import { nearestSymmetric } from './orientations';
import type { FreeSlot } from './slots';

/** Height above the slot at which a block waits to be released, m. */
export const HOVER = 0.0015;
/** Depth below the slot to which the hand lowers the block, m: contact stops it earlier. */
const PRESS = 0.002;
/** Offset (m) and angle (rad) within which lowering begins, and within which it goes on. */
const OFFSET = { begin: 0.0008, continue: 0.003 };
const ANGLE = { begin: 0.015, continue: 0.06 };
/** Offset beyond which a block rises before it crosses, m. */
const BESIDE = 0.012;
/** Height below that of the crossing at which a block may still cross, m. */
const SAG = 0.005;

export interface Waypoint {
  /** Wanted position of the centre, m. */
  centre: Vector3;
  orientation: Quaternion;
  stage: 'rise' | 'cross' | 'lower';
  /** Largest speed of the hand, m/s. */
  speed: number;
}

/**
 * Returns the next waypoint of a block at `centre` on its path to `slot`; `setDown` lowers it until
 * it touches.
 */
export function waypoint(centre: Vector3, rotation: Quaternion, slot: FreeSlot, setDown: boolean): Waypoint {
  const orientation = nearestSymmetric(slot.orientation, rotation);
  const offset = Math.hypot(centre.x - slot.position.x, centre.y - slot.position.y);
  const height = slot.position.z + slot.clearance;
  if (offset > BESIDE && centre.z < height - SAG) {
    return { centre: new Vector3(centre.x, centre.y, height), orientation, stage: 'rise', speed: 0.3 };
  }
  const limit = centre.z < height - SAG ? 'continue' : 'begin';
  if (offset > OFFSET[limit] || orientation.angleTo(rotation) > ANGLE[limit]) {
    return { centre: slot.position.clone().setZ(height), orientation, stage: 'cross', speed: 0.3 };
  }
  const drop = setDown ? -PRESS : HOVER;
  return { centre: slot.position.clone().setZ(slot.position.z + drop), orientation, stage: 'lower', speed: 0.04 };
}
