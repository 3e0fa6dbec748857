// The scale of forces in the springs view: follows the greatest force calmly, and how a force shows on it.

/** Times in which the scale makes up most of its lag, s: an impact must not blind, and what follows it must not be lost at once. */
const LAG = { up: 0.15, down: 1.2 };
/** The least that the scale ends at, N: below it forces are the noise of a block that carries nothing. */
const LEAST = 0.001;

export class ForceScale {
  /** Force at the end of the scale, N. */
  end = LEAST;
  private fresh = true;

  /** Follows the greatest force of the moment, N, over `dt` seconds. */
  follow(greatest: number, dt: number): void {
    const goal = Math.max(LEAST, greatest);
    const part = this.fresh ? 1 : 1 - Math.exp(-dt / (goal > this.end ? LAG.up : LAG.down));
    this.end += part * (goal - this.end);
    this.fresh = false;
  }

  /** Forgets what it has seen: the next force is taken as it is. */
  restart(): void {
    this.fresh = true;
  }
}

/**
 * Place of a force on the scale, from -1 (pushes with all) to 1 (pulls with all). It goes with the root, so that the springs of the upper
 * rows, which carry a tenth of what the lowest do, are told from those that carry nothing. The shader of the springs has it too.
 */
export function place(force: number, end: number): number {
  return Math.sign(force) * Math.sqrt(Math.min(1, Math.abs(force) / end));
}

/** The force at a place of the scale, N. */
export function forceAt(place: number, end: number): number {
  return Math.sign(place) * place * place * end;
}

/** The unit in which a scale that ends at a force (N) is told. */
export function unitOf(end: number): 'N' | 'mN' {
  return end < 0.1 ? 'mN' : 'N';
}

/** A force without its sign, for people: two figures that count. */
export function figures(force: number, unit: 'N' | 'mN'): string {
  return String(Number(Math.abs(unit === 'mN' ? force * 1000 : force).toPrecision(2)));
}
