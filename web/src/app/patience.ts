// Patience with the engine: what the page waits for, and since when.

/** Time after which the engine takes long, s. */
const LONG = 2;

/** Answer of the engine that the page waits for. */
export type Awaited = 'engine' | 'world' | 'step';

export class Patience {
  private awaited: Awaited | null = null;
  private since = 0;

  /** Begins to wait at a time, s. */
  begin(awaited: Awaited, now: number): void {
    [this.awaited, this.since] = [awaited, now];
  }

  /** Ends the wait. */
  end(): void {
    this.awaited = null;
  }

  /** Returns what has been waited for too long at a time (s), or null. */
  late(now: number): Awaited | null {
    return this.awaited !== null && now - this.since > LONG ? this.awaited : null;
  }
}
