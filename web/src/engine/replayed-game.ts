// A recorded game that is played again, with the arrays of a game.

import { LATTICE_STRIDE } from '../view/lattice';
import { POSE_STRIDE, type Contact, type Form, type Update } from './game-protocol';
import type { Replayed } from './played';
import type { LastMove, RecordEngine, RecordState, ReplayState, Rules } from './protocol';
import type { Engine, LoadedEngine } from './record-engine';
import { particleOffset } from './scene';

/** Frames that are played without a break on the path to another one. */
const SLICE = 30;

export class ReplayedGame implements Replayed {
  readonly length: number;
  readonly particleOffset: number;
  readonly rules: Rules;
  readonly stiffness: number;
  readonly form: Form;
  readonly springStiffness: number | null;
  private readonly recorded: InstanceType<Engine['Replay']>;
  private readonly memory: WebAssembly.Memory;

  /** Throws an Error whose message is for the user. */
  constructor(
    record: Uint8Array,
    { engine, memory }: LoadedEngine,
    private readonly origin: Exclude<RecordEngine, 'missing'>,
  ) {
    this.memory = memory;
    this.recorded = new engine.Replay(record);
    this.length = this.recorded.length;
    const text = this.recorded.scene();
    const scene = JSON.parse(text) as { stiffness: number; form?: Form; springs?: { stiffness?: number } };
    this.particleOffset = particleOffset(text);
    this.rules = JSON.parse(this.recorded.rules()) as Rules;
    this.stiffness = scene.stiffness;
    this.form = scene.form ?? 'rigid';
    this.springStiffness = this.form === 'lattice' ? (scene.springs?.stiffness ?? scene.stiffness) : null;
  }

  get replay(): ReplayState {
    const { frame, frames, isSame } = this.recorded;
    return { frame, frames, engine: this.origin, same: isSame };
  }

  free(): void {
    this.recorded.free();
  }

  sizes(): Float32Array {
    return Float32Array.from(this.recorded.sizes());
  }

  poses(): Float32Array {
    const pointer = this.recorded.posesPtr();
    return Float32Array.from(new Float64Array(this.memory.buffer, pointer, this.length * POSE_STRIDE));
  }

  lattices(): Float32Array | null {
    if (this.form === 'rigid') return null;
    const pointer = this.recorded.latticesPtr();
    return new Float32Array(this.memory.buffer, pointer, this.length * LATTICE_STRIDE).slice();
  }

  xray(): Float32Array {
    return Float32Array.from(this.recorded.xray());
  }

  world(): Uint8Array {
    return this.recorded.world();
  }

  hash(): string {
    return this.recorded.hash();
  }

  time(): number {
    return this.recorded.time();
  }

  contacts(): Contact[] {
    return [];
  }

  lastMove(): LastMove | null {
    return null;
  }

  sounds(): Float32Array {
    return this.recorded.sounds();
  }

  canPlace(): boolean {
    return false;
  }

  record(): RecordState | null {
    return null;
  }

  step(): Update | null {
    const update = this.recorded.step();
    return update === undefined ? null : (JSON.parse(update) as Update);
  }

  seek(frame: number): boolean {
    return this.recorded.seek(frame, SLICE);
  }

  update(): Update | null {
    const { update } = this.recorded;
    return update === undefined ? null : (JSON.parse(update) as Update);
  }
}
