// How finely the page draws: a tier for what the device can do, found by measuring.

export interface Tier {
  name: 'low' | 'medium' | 'high';
  /** Most device pixels per CSS pixel. */
  pixels: number;
  shadow: number;
  /** Directions in which a surface looks for the sky. */
  directions: number;
}

export const TIERS: readonly Tier[] = [
  { name: 'low', pixels: 1, shadow: 1024, directions: 1 },
  { name: 'medium', pixels: 1.5, shadow: 2048, directions: 7 },
  { name: 'high', pixels: 2, shadow: 4096, directions: 7 },
];

/** Frames in a row that are judged together. */
const SAMPLE = 24;
/** Time of a frame above which drawing is too dear, and below which there is room to spare, s. */
const SLOW = 0.024;
const QUICK = 0.0175;

/** Chooses the tier from the times between frames that were drawn one after the other. */
export class Quality {
  private readonly times: number[] = [];
  /** A tier that was too dear is not tried again. */
  private ceiling = TIERS.length - 1;
  private quickRuns = 0;

  constructor(
    private index: number,
    private readonly fixed: boolean,
  ) {}

  get tier(): Tier {
    return TIERS[this.index];
  }

  /** A frame took `seconds` from its start to the next frame's; whether the tier changed. */
  judge(seconds: number): boolean {
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
    this.quickRuns = median < QUICK ? this.quickRuns + 1 : 0;
    if (this.quickRuns >= 4 && this.index < this.ceiling) {
      this.index += 1;
      this.quickRuns = 0;
      return true;
    }
    return false;
  }
}
