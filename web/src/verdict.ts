// Whether the tower stands, moves or has fallen, told from poses alone.

import { POSE_STRIDE } from './protocol';

export type State = 'standing' | 'moving' | 'fallen';

/** Way down, m, after which a block that nobody holds counts as fallen. */
const FALL = 0.005;
/** Speed, m/s, above which something moves. */
const SPEED = 0.004;
/** Time, s, that a block is in the player's care after it was let go. */
const CARE = 1.5;

export class Verdict {
  /** Of the centres, were no block strained, m. */
  readonly heights: Float64Array;
  /** Simulated time until which a block is in the player's care. */
  private readonly care: Float64Array;
  private readonly fallen = new Set<number>();

  constructor(poses: Float32Array) {
    const count = poses.length / POSE_STRIDE;
    this.heights = Float64Array.from({ length: count }, (_, body) => poses[body * POSE_STRIDE + 2]);
    this.care = new Float64Array(count).fill(-1);
  }

  /** Takes in a state; `held` is the block in the hand, `sunk` by how much strain lets each block be lower (m): that is no fall. */
  judge(
    poses: Float32Array,
    time: number,
    maxSpeed: number,
    held: number | null,
    sunk: ArrayLike<number> | null = null,
  ): State {
    if (held !== null) this.care[held] = time + CARE;
    for (let body = 0; body < this.heights.length; body++) {
      const height = poses[body * POSE_STRIDE + 2] + (sunk?.[body] ?? 0);
      // A block in care takes its new height with it: putting it on the table is no fall.
      if (this.care[body] >= time) this.heights[body] = height;
      else if (this.heights[body] - height > FALL) this.fallen.add(body);
    }
    if (this.fallen.size > 0) return 'fallen';
    return maxSpeed > SPEED ? 'moving' : 'standing';
  }

  /** Number of blocks that have fallen. */
  get count(): number {
    return this.fallen.size;
  }
}
