// The strip under a scene in the plane: the largest number of iterations of a step in each of the
// last pictures, on a logarithmic scale.

/** Number of pictures in the strip. */
export const MAX_BARS = 180;

/**
 * Returns the height of a bar, 0 to 1, for a number of iterations; `max` fills the strip and one
 * iteration a tenth of it.
 */
export function barHeight(iterations: number, max: number): number {
  if (iterations <= 0) return 0;
  return Math.min(1, 0.1 + (0.9 * Math.log(iterations)) / Math.log(Math.max(2, max)));
}

export class Chart {
  private readonly values: number[] = [];

  clear(): void {
    this.values.length = 0;
  }

  add(iterations: number): void {
    this.values.push(iterations);
    if (this.values.length > MAX_BARS) this.values.shift();
  }

  /** Newest last. */
  get bars(): readonly number[] {
    return this.values;
  }
}
