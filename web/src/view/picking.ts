// Blocks under a ray.

import { Vector3 } from 'three';
import { POSE_STRIDE } from '../engine/game-protocol';
import type { Bodies } from './bodies';

export interface Hit {
  body: number;
  /** m. */
  distance: number;
  /** In the world, m. */
  point: Vector3;
  /** In the body's frame by the pose alone, where the hand grasps it, m. */
  anchor: Vector3;
  /** Outward normal of the face, in the world. */
  normal: Vector3;
}

/** Returns the first block on a ray (unit direction). */
export function pick(bodies: Bodies, origin: Vector3, direction: Vector3): Hit | null {
  let best: Hit | null = null;
  for (let body = 0; body < bodies.count; body++) {
    if (!mayHit(bodies, body, origin, direction)) continue;
    // In the frame of the unstrained block: an affine map keeps the ratios of distances along a
    // line.
    const back = bodies.axes(body).invert();
    const o = origin.clone().sub(bodies.position(body)).applyMatrix3(back);
    const d = direction.clone().applyMatrix3(back);
    const half = bodies.size(body).multiplyScalar(0.5);
    let near = -Infinity;
    let far = Infinity;
    let axis = 0;
    for (let k = 0; k < 3; k++) {
      const inverse = 1 / d.getComponent(k);
      const a = (-half.getComponent(k) - o.getComponent(k)) * inverse;
      const b = (half.getComponent(k) - o.getComponent(k)) * inverse;
      if (Math.min(a, b) > near) {
        near = Math.min(a, b);
        axis = k;
      }
      far = Math.min(far, Math.max(a, b));
    }
    if (near > far || near <= 0 || (best && near >= best.distance)) continue;
    const point = origin.clone().addScaledVector(direction, near);
    const normal = new Vector3()
      .setComponent(axis, -Math.sign(d.getComponent(axis)))
      .applyMatrix3(back.transpose())
      .normalize();
    best = { body, distance: near, point, anchor: bodies.toLocal(body, point), normal };
  }
  return best;
}

/** Largest distance of a corner from the centre by strain, over that without strain. */
const MAX_STRAIN = 2;

/**
 * Returns true if a ray (unit direction) passes through the sphere around a block: a cheap test
 * that most blocks fail.
 */
function mayHit({ shown, sizes }: Bodies, body: number, origin: Vector3, direction: Vector3): boolean {
  const at = POSE_STRIDE * body;
  const [x, y, z] = [shown[at] - origin.x, shown[at + 1] - origin.y, shown[at + 2] - origin.z];
  const along = x * direction.x + y * direction.y + z * direction.z;
  const [a, b, c] = [sizes[3 * body], sizes[3 * body + 1], sizes[3 * body + 2]];
  const radius = (MAX_STRAIN / 2) * Math.sqrt(a * a + b * b + c * c);
  return x * x + y * y + z * z - along * along <= radius * radius;
}
