// Resolution and effects of the picture: a tier that the device can draw, found by measurement.

export interface Tier {
  name: 'low' | 'medium' | 'high';
  /** Largest number of device pixels per CSS pixel. */
  pixels: number;
  shadow: number;
  /** Directions in which a surface samples the sky. */
  directions: number;
}

export const TIERS: readonly Tier[] = [
  { name: 'low', pixels: 1, shadow: 1024, directions: 1 },
  { name: 'medium', pixels: 1.5, shadow: 2048, directions: 7 },
  { name: 'high', pixels: 2, shadow: 4096, directions: 7 },
];

/** Consecutive frames per sample. */
const SAMPLE = 24;
/** Frame times above which drawing is too expensive, and below which there is time to spare, s. */
const SLOW = 0.024;
const FAST = 0.0175;

/** Chooses the tier from the times between consecutive frames. */
export class Quality {
  private readonly times: number[] = [];
  /** Highest tier to try: one that was too slow is not tried again. */
  private ceiling = TIERS.length - 1;
  private fastRuns = 0;

  constructor(
    private index: number,
    private readonly fixed: boolean,
  ) {}

  get tier(): Tier {
    return TIERS[this.index];
  }

  /** Takes the time from one frame to the next, s; returns true if the tier changed. */
  sample(seconds: number): boolean {
    if (this.fixed || seconds > 1) return false;
    this.times.push(seconds);
    if (this.times.length < SAMPLE) return false;
    const median = this.times.sort((a, b) => a - b)[SAMPLE >> 1];
    this.times.length = 0;
    if (median > SLOW && this.index > 0) {
      this.index -= 1;
      this.ceiling = this.index;
      return true;
    }
    this.fastRuns = median < FAST ? this.fastRuns + 1 : 0;
    if (this.fastRuns >= 4 && this.index < this.ceiling) {
      this.index += 1;
      this.fastRuns = 0;
      return true;
    }
    return false;
  }
}
