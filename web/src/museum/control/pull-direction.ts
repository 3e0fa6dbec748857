// Direction in which a block is pulled out of the tower.

import { Quaternion, Vector3 } from 'three';

/**
 * Returns the block's long axis, which leans with the tower: pulled level, a leaning block would be
 * lifted against the one above it or pressed on the one beneath. A block that leans by more than
 * `limit` rad belongs to no row and is pulled level.
 */
export function pullDirection(rotation: Quaternion, limit = 0.3): Vector3 {
  const axis = new Vector3(1, 0, 0).applyQuaternion(rotation);
  if (Math.abs(axis.z) < Math.sin(limit)) return axis;
  return Math.hypot(axis.x, axis.y) > 1e-3 ? axis.setZ(0).normalize() : new Vector3(1, 0, 0);
}
