// The strip under a scene in the plane: the most iterations of a step in each of the last pictures, on a scale that goes with the logarithm.

/** Pictures that the strip keeps. */
export const KEPT = 180;

/** Height of a bar, 0 to 1, for a number of iterations where `most` fills the strip. One iteration is a tenth of it. */
export function height(iterations: number, most: number): number {
  if (iterations <= 0) return 0;
  return Math.min(1, 0.1 + (0.9 * Math.log(iterations)) / Math.log(Math.max(2, most)));
}

export class Chart {
  private readonly values: number[] = [];

  restart(): void {
    this.values.length = 0;
  }

  add(iterations: number): void {
    this.values.push(iterations);
    if (this.values.length > KEPT) this.values.shift();
  }

  /** Newest last. */
  get bars(): readonly number[] {
    return this.values;
  }

  /** The most of what is kept. */
  get most(): number {
    return Math.max(0, ...this.values);
  }
}
