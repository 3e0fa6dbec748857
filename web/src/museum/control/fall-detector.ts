// Detects from poses alone whether the tower stands, moves or has fallen.

import { POSE_STRIDE, type TowerState } from '../../engine/game-protocol';

/** Descent after which a block that is not held counts as fallen, m. */
const FALL = 0.005;
/** Speed above which the tower counts as moving, m/s. */
const SPEED = 0.004;
/** Simulated time after a release during which a descent is no fall, s. */
const GRACE = 1.5;

export class FallDetector {
  /** Heights of the centres without deformation, m. */
  readonly heights: Float64Array;
  /** Simulated time until which a descent is no fall, s. */
  private readonly graceUntil: Float64Array;
  private readonly fallen = new Set<number>();

  constructor(poses: ArrayLike<number>) {
    const count = poses.length / POSE_STRIDE;
    this.heights = Float64Array.from({ length: count }, (_, body) => poses[body * POSE_STRIDE + 2]);
    this.graceUntil = new Float64Array(count).fill(-1);
  }

  /**
   * Takes the poses at `time` (s). `held`: body in the hand.
   * `settlement`: descent of each block by deformation, m, which is no fall.
   */
  advance(
    poses: ArrayLike<number>,
    time: number,
    maxSpeed: number,
    held: number | null,
    settlement: ArrayLike<number> | null = null,
  ): TowerState {
    if (held !== null) this.graceUntil[held] = time + GRACE;
    for (let body = 0; body < this.heights.length; body++) {
      const height = poses[body * POSE_STRIDE + 2] + (settlement?.[body] ?? 0);
      // A held block takes its new height with it: putting it on the table is no fall.
      if (this.graceUntil[body] >= time) this.heights[body] = height;
      else if (this.heights[body] - height > FALL) this.fallen.add(body);
    }
    if (this.fallen.size > 0) return 'fallen';
    return maxSpeed > SPEED ? 'moving' : 'standing';
  }

  /** Bodies that have fallen. */
  get bodies(): number[] {
    return [...this.fallen];
  }
}
