// Detects that simulated time is slow for longer than a hiccup.

/** Simulated time per wall time below which time is slow. */
export const SLOW = 0.95;
/** Duration after which slowness is reported, ms. */
const LASTING = 1500;

export class SlowMotion {
  private since = 0;
  private reported = false;

  reset(): void {
    this.since = 0;
    this.reported = false;
  }

  /** Takes the simulated time per wall time; returns true once it has been slow for long enough. */
  begins(factor: number): boolean {
    if (factor >= SLOW) {
      this.reset();
      return false;
    }
    if (this.since === 0) this.since = performance.now();
    if (this.reported || performance.now() - this.since <= LASTING) return false;
    return (this.reported = true);
  }
}
