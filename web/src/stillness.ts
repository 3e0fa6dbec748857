// Whether a tower has come to rest, so that the forces in its contacts are those of rest.

import type { Form } from './protocol';

/** Speed of the fastest body from which a tower moves, m/s. */
const MOVING = 1e-3;
/** Steps between two looks at the forces: a quarter of a second. */
const STEPS = 15;
/** By how much a force may differ between two looks at rest: by so many newtons, or by such a part. */
const SAME = { force: 0.005, part: 0.02 };

/** What of a step tells whether things are at rest. */
export interface Motion {
  /** Of the fastest body, m/s. */
  speed: number;
  /** Whether a hand is at work. */
  held: boolean;
  form: Form;
  /** Stiffness of the springs within the blocks, N/m; null where they are rigid. */
  springs: number | null;
}

/** Slowness alone does not tell: weight comes on over the first tenths of a second, and what tips begins slowly. */
export class Stillness {
  /** Whether the tower is at rest. */
  still = false;
  private steps = 0;
  private forces: Float32Array | null = null;
  private form: Form | null = null;
  private springs: number | null = null;

  /** A new tower, or one that has moved: nothing is known of its forces. */
  restart(): void {
    this.still = false;
    this.steps = 0;
    this.forces = null;
  }

  /** Takes in a step; `look` tells the forces. Whether rest has begun or ended. */
  advance(motion: Motion, look: () => Float32Array): boolean {
    const was = this.still;
    const same = this.form === motion.form && this.springs === motion.springs;
    this.form = motion.form;
    this.springs = motion.springs;
    if (!same || motion.held || motion.speed >= MOVING) {
      this.restart();
    } else if (++this.steps % STEPS === 0) {
      const forces = look();
      this.still = this.forces !== null && alike(this.forces, forces);
      // At rest they are held against those that were told: creep must not go unseen.
      if (!was || !this.still) this.forces = forces;
    }
    return this.still !== was;
  }
}

/** Whether two looks tell the same; what is no number stays none. */
function alike(a: Float32Array, b: Float32Array): boolean {
  return a.every((x, i) => Object.is(x, b[i]) || Math.abs(x - b[i]) <= Math.max(SAME.force, SAME.part * Math.abs(x)));
}
