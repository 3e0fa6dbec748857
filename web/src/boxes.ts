// Questions of geometry about boxes: what a ray meets, what lies above a block, how a block may be turned without looking different.

import { Quaternion, Vector3 } from 'three';
import type { Bodies } from './bodies';
import { POSE_STRIDE } from './protocol';

export interface Hit {
  body: number;
  distance: number;
  /** In the world, m. */
  point: Vector3;
  /** In the body's frame, of the pose alone: there the hand holds it, m. */
  anchor: Vector3;
  /** Outward normal of the face, in the world. */
  normal: Vector3;
}

/** First block that a ray meets. */
export function pick(bodies: Bodies, origin: Vector3, direction: Vector3): Hit | null {
  let best: Hit | null = null;
  for (let body = 0; body < bodies.count; body++) {
    if (!mayMeet(bodies, body, origin, direction)) continue;
    // In the block as it was made: a map that keeps lines keeps the distances along them too, in parts of the ray.
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

/** How far strain may take a corner, over where it was made. */
const STRAINED = 2;

/** Whether a ray (unit direction) passes through the ball around a block: most do not, and that is told at once. */
function mayMeet({ shown, sizes }: Bodies, body: number, origin: Vector3, direction: Vector3): boolean {
  const at = POSE_STRIDE * body;
  const [x, y, z] = [shown[at] - origin.x, shown[at + 1] - origin.y, shown[at + 2] - origin.z];
  const along = x * direction.x + y * direction.y + z * direction.z;
  const [a, b, c] = [sizes[3 * body], sizes[3 * body + 1], sizes[3 * body + 2]];
  const radius = (STRAINED / 2) * Math.sqrt(a * a + b * b + c * c);
  return x * x + y * y + z * z - along * along <= radius * radius;
}

function inside(bodies: Bodies, body: number, point: Vector3): boolean {
  const local = point
    .clone()
    .sub(bodies.position(body, bodies.newest))
    .applyMatrix3(bodies.axes(body, bodies.newest).invert());
  const size = bodies.size(body);
  return Math.abs(local.x) < size.x / 2 && Math.abs(local.y) < size.y / 2 && Math.abs(local.z) < size.z / 2;
}

/**
 * Whether the block can be lifted: nothing is above it within `clearance` metres.
 * Load alone does not tell: a loose block carries nothing and still has the tower over it.
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
  // Points of the block's own top, whichever of its faces that is, and of the space above it.
  for (const x of [-0.48, -0.24, 0, 0.24, 0.48]) {
    for (const y of [-0.48, 0, 0.48]) {
      for (const z of [-0.48, 0, 0.48]) {
        const point = bodies.surface(body, new Vector3(x * size.x, y * size.y, z * size.z), bodies.newest);
        for (const height of [0.25 * clearance, clearance]) {
          point.z = centre + rise + height;
          if (above.some(other => inside(bodies, other, point))) return false;
        }
      }
    }
  }
  return true;
}

/** Of the four turns in which a box looks the same as in `wanted`, the nearest to `current`. */
export function nearestAlike(wanted: Quaternion, current: Quaternion): Quaternion {
  let best = wanted;
  for (const [x, y, z, w] of [
    [0, 0, 0, 1],
    [1, 0, 0, 0],
    [0, 1, 0, 0],
    [0, 0, 1, 0],
  ]) {
    const alike = wanted.clone().multiply(new Quaternion(x, y, z, w));
    if (alike.angleTo(current) < best.angleTo(current)) best = alike;
  }
  return best;
}

/**
 * The direction in which a hand draws a block out of the tower: its own long axis, which leans with the tower. Drawn level, a leaning block is lifted
 * against what lies above it or pressed on what bears it. A block that leans by more than `limit` rad is in no row, and is drawn level.
 */
export function drawn(turn: Quaternion, limit = 0.3): Vector3 {
  const axis = new Vector3(1, 0, 0).applyQuaternion(turn);
  if (Math.abs(axis.z) < Math.sin(limit)) return axis;
  return Math.hypot(axis.x, axis.y) > 1e-3 ? axis.setZ(0).normalize() : new Vector3(1, 0, 0);
}

/** The nearest turn to `current` in which the block lies flat, if it is within `limit` rad; `current` itself if not. */
export function levelled(current: Quaternion, limit: number): Quaternion {
  const up = new Vector3(0, 0, 1).applyQuaternion(current);
  const flat = new Vector3(0, 0, Math.sign(up.z) || 1);
  const level = new Quaternion().setFromUnitVectors(up, flat).multiply(current);
  return level.angleTo(current) <= limit ? level : current.clone();
}
