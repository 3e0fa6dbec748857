// Position of a grasped point.

import { POSE_STRIDE, type Quat, type Vec } from '../../engine/game-protocol';
import { add, rotate } from './vectors';

/** Centre, orientation and grasped point (m) of a body held at `anchor` in its frame. */
export function graspedPoint(
  poses: Float64Array,
  body: number,
  anchor: Vec,
): { centre: Vec; point: Vec; orientation: Quat } {
  const at = body * POSE_STRIDE;
  const [x, y, z, ...rest] = poses.subarray(at, at + POSE_STRIDE);
  const orientation = rest as Quat;
  const centre: Vec = [x, y, z];
  return { centre, point: add(centre, rotate(orientation, anchor)), orientation };
}
