// Detects that a tower has come to rest, so that its contact forces are those of rest.

import type { Form } from '../../engine/game-protocol';

/** Speed of the fastest body from which a tower moves, m/s. */
const MOVING = 1e-3;
/** Steps between two samples of the forces: a quarter of a second. */
const STEPS = 15;
/** Difference of a force between two samples at rest: absolute in N, or relative. */
const TOLERANCE = { absolute: 0.005, relative: 0.02 };

/** Quantities of a step that rest depends on. */
export interface Motion {
  /** Speed of the fastest body, m/s. */
  speed: number;
  /** True while a hand holds a block. */
  held: boolean;
  form: Form;
  /** Stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  springs: number | null;
}

/** Speed alone is no criterion: load builds up over the first tenths of a second, and a tipping tower begins slowly. */
export class RestDetector {
  /** True while the tower is at rest. */
  atRest = false;
  private steps = 0;
  private forces: Float32Array | null = null;
  private form: Form | null = null;
  private springs: number | null = null;

  /** Takes a step; `sample` returns the contact forces. */
  advance(motion: Motion, sample: () => Float32Array): void {
    const same = this.form === motion.form && this.springs === motion.springs;
    this.form = motion.form;
    this.springs = motion.springs;
    if (!same || motion.held || motion.speed >= MOVING) {
      this.reset();
    } else if (++this.steps % STEPS === 0) {
      const forces = sample();
      const before = this.atRest;
      this.atRest = this.forces !== null && isClose(this.forces, forces);
      // At rest the reference stays the first sample, so that creep is noticed.
      if (!before || !this.atRest) this.forces = forces;
    }
  }

  private reset(): void {
    this.atRest = false;
    this.steps = 0;
    this.forces = null;
  }
}

/** Returns true if two samples agree; NaN agrees with NaN. */
function isClose(a: Float32Array, b: Float32Array): boolean {
  const { absolute, relative } = TOLERANCE;
  return a.every((x, i) => Object.is(x, b[i]) || Math.abs(x - b[i]) <= Math.max(absolute, relative * Math.abs(x)));
}
