// A record that is played again from its start, frame by frame, and compared with its checks.

import { POSE_STRIDE, type TurnState, type Update } from '../engine/game-protocol';
import type { RecordEngine, Rules, Setup } from '../engine/protocol';
import { engineOf, type Engine, type LoadedEngine } from '../engine/record-engine';
import type { OwnEngine } from '../engine/replayed';
import { beginsAs } from './beginning';
import type { Verified } from './jobs';

/**
 * Begins to check a record with the engine that wrote it: `own`, that of the page, or a kept one
 * below the address `engines`. Without it nothing is checked. `setup` is that of a game which may
 * begin like the record. Throws an Error whose message is for the user where the bytes are no
 * record.
 */
export async function verification(bytes: Uint8Array, own: OwnEngine, engines: URL, setup: Setup) {
  const found = await engineOf(bytes, own, engines);
  const id = own.engine.recordEngine(bytes);
  if (!found) return unchecked(bytes, own, id);
  const begins = beginsAs(bytes, setup, own.memory);
  return new Verification(bytes, found, { engine: id, origin: found === own ? 'own' : 'kept', begins });
}

class Verification {
  private readonly replay: InstanceType<Engine['Replay']>;
  private readonly memory: WebAssembly.Memory;
  private readonly sizes: Float64Array;
  private turn: TurnState | null = null;
  private grasped: number | null = null;
  private pull: number | null = null;
  private height: number;
  private poses: Float32Array;

  constructor(
    bytes: Uint8Array,
    loaded: LoadedEngine,
    private readonly source: { engine: string; origin: RecordEngine; begins: boolean },
  ) {
    this.memory = loaded.memory;
    this.replay = new loaded.engine.Replay(bytes);
    this.sizes = this.replay.sizes();
    this.poses = this.currentPoses();
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
    const { replay, source, turn, pull, height, poses } = this;
    const divergence = replay.divergence();
    return {
      same: replay.isSame,
      ...source,
      rules: JSON.parse(replay.rules()) as Rules,
      scene: replay.scene(),
      turn,
      pull,
      height,
      poses,
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
      if (event !== 'settled') continue;
      this.poses = this.currentPoses();
      this.height = this.top();
    }
  }

  private currentPoses(): Float32Array {
    return Float32Array.from(
      new Float64Array(this.memory.buffer, this.replay.posesPtr(), this.replay.length * POSE_STRIDE),
    );
  }

  /** Height of the highest block, which lies flat, m. */
  private top(): number {
    const { poses, sizes } = this;
    let top = 0;
    for (let body = 0; body < sizes.length / 3; body++)
      top = Math.max(top, poses[POSE_STRIDE * body + 2] + sizes[3 * body + 2] / 2);
    return top;
  }
}

/** Content of a record as it stands, unchecked. */
function unchecked(bytes: Uint8Array, { engine }: OwnEngine, id: string) {
  const keyframes = new engine.Keyframes(bytes);
  const result = (): Verified => ({
    same: null,
    engine: id,
    origin: 'missing',
    begins: false,
    rules: JSON.parse(keyframes.rules()) as Rules,
    scene: keyframes.scene(),
    turn: null,
    pull: null,
    height: 0,
    poses: Float32Array.from(keyframes.poses(keyframes.seconds)),
    divergence: null,
  });
  return { step: () => 1, result, free: () => keyframes.free() };
}
