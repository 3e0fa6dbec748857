// The scale of forces in the springs view, which follows the largest force smoothly.

import { significant } from '../messages';

/**
 * Time constants of the scale, s: an impact must not saturate it, and must not hide for long what
 * follows.
 */
const TIME_CONSTANT = { up: 0.15, down: 1.2 };
/** Smallest end of the scale, N: smaller forces are noise of blocks without load. */
const MIN_END = 0.001;

export class ForceScale {
  /** Force at the end of the scale, N. */
  end = MIN_END;
  private fresh = true;

  /** Follows the current largest force, N, over `dt` seconds. */
  follow(force: number, dt: number): void {
    const goal = Math.max(MIN_END, force);
    const part = this.fresh ? 1 : 1 - Math.exp(-dt / (goal > this.end ? TIME_CONSTANT.up : TIME_CONSTANT.down));
    this.end += part * (goal - this.end);
    this.fresh = false;
  }

  /** Resets the scale to the next force. */
  reset(): void {
    this.fresh = true;
  }
}

/**
 * Returns the force at a level of the scale, from -1 (full compression) to 1 (full tension), N. The
 * shader of the springs has the inverse: the square root separates the springs of the upper rows,
 * which carry a tenth of the load of the lowest, from those without load.
 */
export function forceAt(level: number, end: number): number {
  return Math.sign(level) * level * level * end;
}

/** Returns the unit of a scale that ends at a force, N. */
export function unitOf(end: number): 'N' | 'mN' {
  return end < 0.1 ? 'mN' : 'N';
}

/** Returns the magnitude of a force with two significant figures. */
export function formatForce(force: number, unit: 'N' | 'mN'): string {
  return significant(Math.abs(unit === 'mN' ? force * 1000 : force), 2);
}
