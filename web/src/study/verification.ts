// A record that is played again from its start, frame by frame, and compared with its checks.

import { POSE_STRIDE, type TurnState, type Update } from '../engine/game-protocol';
import type { Rules } from '../engine/protocol';
import { engineId, recordEngine, Replay } from '../wasm/teeter_wasm.js';
import type { Verified } from './jobs';

export class Verification {
  private readonly replay: Replay;
  private readonly sizes: Float64Array;
  private turn: TurnState | null = null;
  private grasped: number | null = null;
  private pull: number | null = null;
  private height = 0;

  /** Throws an Error whose message is for the user. */
  constructor(
    private readonly bytes: Uint8Array,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.replay = new Replay(bytes);
    this.sizes = this.replay.sizes();
    this.height = this.top();
  }

  /** Plays a frame; returns the part that is done. A record that differs is not played on. */
  step(): number {
    const text = this.replay.step();
    if (text === undefined || !this.replay.isSame) return 1;
    this.observe(JSON.parse(text) as Update);
    return this.replay.frame / this.replay.frames;
  }

  result(): Verified {
    const { replay } = this;
    const divergence = replay.divergence();
    return {
      same: replay.isSame,
      frames: replay.frames,
      hash: replay.hash(),
      engine: recordEngine(this.bytes),
      own: engineId(),
      rules: JSON.parse(replay.rules()) as Rules,
      scene: replay.scene(),
      turn: this.turn,
      pull: this.pull,
      height: this.height,
      divergence: divergence === undefined ? null : (JSON.parse(divergence) as Verified['divergence']),
    };
  }

  free(): void {
    this.replay.free();
  }

  private observe({ events, report, turn }: Update): void {
    this.turn = turn ?? null;
    for (const { event } of events) {
      if (event === 'grasped') this.grasped ??= report.time;
      if (event === 'placed' && this.grasped !== null) this.pull ??= report.time - this.grasped;
      if (event === 'settled') this.height = this.top();
    }
  }

  /** Height of the highest block, which lies flat, m. */
  private top(): number {
    const poses = new Float64Array(this.memory.buffer, this.replay.posesPtr(), this.replay.length * POSE_STRIDE);
    let top = 0;
    for (let body = 0; body < this.replay.length; body++)
      top = Math.max(top, poses[POSE_STRIDE * body + 2] + this.sizes[3 * body + 2] / 2);
    return top;
  }
}
