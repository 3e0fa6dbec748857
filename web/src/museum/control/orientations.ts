// Orientations of a box.

import { Quaternion, Vector3 } from 'three';

/**
 * Returns that of the four orientations in which a box looks like `wanted` which is nearest to
 * `current`.
 */
export function nearestSymmetric(wanted: Quaternion, current: Quaternion): Quaternion {
  let best = wanted;
  for (const [x, y, z, w] of [
    [0, 0, 0, 1],
    [1, 0, 0, 0],
    [0, 1, 0, 0],
    [0, 0, 1, 0],
  ]) {
    const symmetric = wanted.clone().multiply(new Quaternion(x, y, z, w));
    if (symmetric.angleTo(current) < best.angleTo(current)) best = symmetric;
  }
  return best;
}

/**
 * Returns the nearest orientation to `current` in which the block lies flat if it is within `limit`
 * rad, else `current`.
 */
export function levelled(current: Quaternion, limit: number): Quaternion {
  const up = new Vector3(0, 0, 1).applyQuaternion(current);
  const flat = new Vector3(0, 0, Math.sign(up.z) || 1);
  const level = new Quaternion().setFromUnitVectors(up, flat).multiply(current);
  return level.angleTo(current) <= limit ? level : current.clone();
}
