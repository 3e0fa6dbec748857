// Distance between two towers of the same blocks.

import { POSE_STRIDE } from '../engine/game-protocol';
import { text } from '../messages';

export interface TowerDistance {
  /** Largest distance between the centres of a block, m, and the block. */
  max: number;
  body: number;
  /** Mean over all blocks, m. */
  mean: number;
  /** Distance of each block, m. */
  each: Float32Array;
}

/** Returns the distances between the centres of each block in two arrays of poses. */
export function towerDistance(a: ArrayLike<number>, b: ArrayLike<number>): TowerDistance {
  const count = a.length / POSE_STRIDE;
  const each = new Float32Array(count);
  let [max, body, sum] = [0, 0, 0];
  for (let i = 0; i < count; i++) {
    const at = i * POSE_STRIDE;
    const distance = Math.hypot(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]);
    each[i] = distance;
    sum += distance;
    if (distance > max) [max, body] = [distance, i];
  }
  return { max, body, mean: count > 0 ? sum / count : 0, each };
}

/** Formats a distance (m) in mm: hundredths below a centimetre. */
export function millimetres(distance: number): string {
  const mm = 1000 * distance;
  return text.readouts.millimetres(mm, mm < 10 ? 2 : mm < 100 ? 1 : 0);
}
