// A block in the hand, as those who lead the hand along see it.

import { POSE_STRIDE, type Quat, type Vec, type Wish } from './protocol';
import { add, rotate } from './vectors';

/** Whether two wishes are of the same block, held at the same point. */
export function sameGrasp(a: Wish | null, b: Wish | null): boolean {
  return a !== null && b !== null && a.body === b.body && a.anchor.every((x, i) => x === b.anchor[i]);
}

/** Where the block of a wish is, and the point at which it is held, from the poses of all, m. */
export function grasped(poses: Float64Array, wish: Wish): { centre: Vec; point: Vec; orientation: Quat } {
  const at = wish.body * POSE_STRIDE;
  const [x, y, z, ...turn] = poses.subarray(at, at + POSE_STRIDE);
  const orientation = turn as Quat;
  const centre: Vec = [x, y, z];
  return { centre, point: add(centre, rotate(orientation, wish.anchor)), orientation };
}
