// Vector arithmetic on plain arrays.

import type { Quat, Vec } from '../../engine/game-protocol';

export const add = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec, k: number): Vec => [k * a[0], k * a[1], k * a[2]];
export const length = (a: Vec): number => Math.hypot(a[0], a[1], a[2]);
const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Returns a vector rotated by a unit quaternion. */
export function rotate([x, y, z, w]: Quat, v: Vec): Vec {
  const axis: Vec = [x, y, z];
  const t = scale(cross(axis, v), 2);
  return add(add(v, scale(t, w)), cross(axis, t));
}

/** Returns `from` rotated towards `to` by at most `limit` rad along the shorter arc. */
export function rotateTowards(from: Quat, to: Quat, limit: number): Quat {
  const dot = from.reduce((sum, x, i) => sum + x * to[i], 0);
  const near = dot < 0 ? to.map(x => -x) : to;
  const angle = 2 * Math.acos(Math.min(1, Math.abs(dot)));
  if (angle <= limit) return [...near] as Quat;
  const [a, b] = [Math.sin(angle / 2 - limit / 2), Math.sin(limit / 2)];
  const mixed = from.map((x, i) => a * x + b * near[i]);
  const norm = Math.hypot(...mixed);
  return mixed.map(x => x / norm) as Quat;
}
