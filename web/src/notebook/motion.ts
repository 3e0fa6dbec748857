// States of a tower over time, and the picture between two of them.

import { POSE_STRIDE } from '../engine/game-protocol';
import type { Bodies } from '../view/bodies';

export class Motion {
  /** Number of states. */
  readonly states: number;
  private readonly length: number;
  private from = -1;

  /** `poses`: of all states, one after the other; `count`: of blocks. */
  constructor(
    private readonly poses: Float32Array,
    count: number,
  ) {
    this.length = POSE_STRIDE * count;
    this.states = this.length > 0 ? Math.floor(poses.length / this.length) : 0;
  }

  /** Returns the poses of a state. */
  state(index: number): Float32Array {
    return this.poses.slice(this.length * index, this.length * (index + 1));
  }

  /** Returns a frame within the states. */
  within(frame: number): number {
    return Math.min(this.states - 1, Math.max(0, frame));
  }

  /** Sets the blocks to a frame; returns the largest change, m. */
  show(frame: number, bodies: Bodies): number {
    const at = this.within(frame);
    const from = Math.min(Math.floor(at), Math.max(0, this.states - 2));
    if (from !== this.from) {
      bodies.arrive(this.state(from));
      bodies.arrive(this.state(Math.min(from + 1, this.states - 1)));
      this.from = from;
    }
    return bodies.blend(at - from);
  }
}
