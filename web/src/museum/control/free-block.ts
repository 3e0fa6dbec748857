// Blocks that can be lifted.

import { Vector3 } from 'three';
import type { Bodies } from '../../view/bodies';

/**
 * Returns true if nothing is above the block within `clearance` metres, so that it can be lifted.
 * Load is no criterion: a loose block carries nothing and still has the tower above it.
 */
export function isFree(bodies: Bodies, body: number, clearance = 0.012): boolean {
  const size = bodies.size(body);
  const rise = bodies.halfExtent(body, new Vector3(0, 0, 1), bodies.newest);
  const centre = bodies.position(body, bodies.newest).z;
  const reach = size.length() / 2;
  const above: number[] = [];
  for (let other = 0; other < bodies.count; other++) {
    const offset = bodies.position(other, bodies.newest).sub(bodies.position(body, bodies.newest));
    const near = reach + bodies.size(other).length() / 2 + clearance;
    if (other !== body && offset.z > 0 && offset.length() < near) above.push(other);
  }
  if (above.length === 0) return true;
  // Sample points above the block's top, whichever of its faces that is.
  for (const x of [-0.48, -0.24, 0, 0.24, 0.48]) {
    for (const y of [-0.48, 0, 0.48]) {
      for (const z of [-0.48, 0, 0.48]) {
        const point = bodies.surface(body, new Vector3(x * size.x, y * size.y, z * size.z), bodies.newest);
        for (const height of [0.25 * clearance, clearance]) {
          point.z = centre + rise + height;
          if (above.some(other => isInside(bodies, other, point))) return false;
        }
      }
    }
  }
  return true;
}

function isInside(bodies: Bodies, body: number, point: Vector3): boolean {
  const local = point
    .clone()
    .sub(bodies.position(body, bodies.newest))
    .applyMatrix3(bodies.axes(body, bodies.newest).invert());
  const size = bodies.size(body);
  return Math.abs(local.x) < size.x / 2 && Math.abs(local.y) < size.y / 2 && Math.abs(local.z) < size.z / 2;
}
