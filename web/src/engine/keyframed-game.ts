// The keyframes of a record whose engine is missing: its poses second by second, and what lies
// between them on a straight line. Nothing of it is computed or checked.

import type { Keyframes } from '../wasm/teeter_wasm.js';
import type { Contact, Form, Update } from './game-protocol';
import type { Replayed } from './played';
import type { LastMove, RecordState, ReplayState, Rules } from './protocol';
import { particleOffset } from './scene';

export class KeyframedGame implements Replayed {
  readonly length: number;
  readonly particleOffset: number;
  readonly rules: Rules;
  readonly stiffness: number;
  /** A keyframe has no particles. */
  readonly form: Form = 'rigid';
  readonly springStiffness = null;
  private frame = 0;

  constructor(private readonly keyframes: Keyframes) {
    this.length = keyframes.length;
    const scene = keyframes.scene();
    this.particleOffset = particleOffset(scene);
    this.rules = JSON.parse(keyframes.rules()) as Rules;
    ({ stiffness: this.stiffness } = JSON.parse(scene) as { stiffness: number });
  }

  get replay(): ReplayState {
    return { frame: this.frame, frames: this.keyframes.frames, engine: 'missing', same: null };
  }

  free(): void {
    this.keyframes.free();
  }

  sizes(): Float32Array {
    return Float32Array.from(this.keyframes.sizes());
  }

  poses(): Float32Array {
    return Float32Array.from(this.keyframes.poses(this.time()));
  }

  time(): number {
    const { frames, seconds } = this.keyframes;
    return frames > 0 ? (this.frame / frames) * seconds : 0;
  }

  step(): Update | null {
    if (this.frame === this.keyframes.frames) return null;
    this.frame += 1;
    return this.update();
  }

  seek(frame: number): boolean {
    this.frame = Math.min(frame, this.keyframes.frames);
    return true;
  }

  update(): Update {
    const report = {
      time: this.time(),
      awake: 0,
      touching: 0,
      penetration: 0,
      max_speed: 0,
      quarantined: [],
      hand: null,
    };
    return {
      report,
      hand: null,
      slots: [],
      tower: 'standing',
      fallen: [],
      quarantined: [],
      at_rest: false,
      form: this.form,
      spring_stiffness: null,
      events: [],
    };
  }

  lattices(): null {
    return null;
  }

  sounds(): null {
    return null;
  }

  xray(): Float32Array {
    return new Float32Array(2 * this.length).fill(NaN);
  }

  world(): Uint8Array {
    return new Uint8Array();
  }

  hash(): string {
    return '';
  }

  contacts(): Contact[] {
    return [];
  }

  lastMove(): LastMove | null {
    return null;
  }

  canPlace(): boolean {
    return false;
  }

  record(): RecordState | null {
    return null;
  }
}
