// How far two towers of the same blocks are apart.

import { POSE_STRIDE } from '../protocol';

export interface Apart {
  /** Distance of the centres of the block that is farthest off, m, and which it is. */
  most: number;
  body: number;
  /** Mean over all blocks, m. */
  mean: number;
  /** Of each block, m. */
  each: Float32Array;
}

/** Distances between the centres of each block in two arrays of poses. */
export function apart(a: ArrayLike<number>, b: ArrayLike<number>): Apart {
  const count = a.length / POSE_STRIDE;
  const each = new Float32Array(count);
  let [most, body, sum] = [0, 0, 0];
  for (let i = 0; i < count; i++) {
    const at = i * POSE_STRIDE;
    const distance = Math.hypot(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]);
    each[i] = distance;
    sum += distance;
    if (distance > most) [most, body] = [distance, i];
  }
  return { most, body, mean: count > 0 ? sum / count : 0, each };
}

/** A distance in mm, for people: hundredths below a centimetre. */
export function millimetres(distance: number): string {
  const mm = 1000 * distance;
  return `${mm.toFixed(mm < 10 ? 2 : mm < 100 ? 1 : 0)} mm`;
}
