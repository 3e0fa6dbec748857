// Faces of blocks that are seen.

import { Vector3 } from 'three';
import type { Bodies } from './bodies';
import type { Orbit } from './orbit';
import { pick } from './picking';

/** Smallest cosine between a face's normal and the direction to the eye. */
const FACING = 0.12;
/** Tolerance within which a ray from the eye hits a face, m. */
const AT_FACE = 0.002;

/**
 * Faces in order of preference: ends, which are visible while a block is in the tower, then the
 * others.
 */
const FACES: [axis: 0 | 1 | 2, side: 1 | -1][] = [
  [0, 1],
  [0, -1],
  [1, 1],
  [1, -1],
  [2, 1],
  [2, -1],
];

/** A face in the block's frame. */
export interface Face {
  axis: 0 | 1 | 2;
  side: 1 | -1;
  /** m. */
  middle: Vector3;
}

/** Returns the first face of a block, in order of preference, whose middle is seen; else null. */
export function visibleFace(bodies: Bodies, orbit: Orbit, body: number): Face | null {
  const eye = orbit.camera.position;
  const half = bodies.size(body).multiplyScalar(0.5);
  for (const [axis, side] of FACES) {
    const middle = new Vector3().setComponent(axis, side * half.getComponent(axis));
    const sight = bodies.surface(body, middle).sub(eye);
    const distance = sight.length();
    sight.divideScalar(distance);
    if (outward(bodies, body, axis, side).dot(sight) > -FACING) continue;
    const hit = pick(bodies, eye, sight);
    if (hit?.body === body && Math.abs(hit.distance - distance) <= AT_FACE) return { axis, side, middle };
  }
  return null;
}

/** Returns the outward normal of a face in the world. */
export function outward(bodies: Bodies, body: number, axis: 0 | 1 | 2, side: 1 | -1): Vector3 {
  return new Vector3().setComponent(axis, side).applyQuaternion(bodies.rotation(body));
}
