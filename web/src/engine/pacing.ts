// Time: the steps that are due, the speed of simulated time, and the interpolation between two
// states.

/**
 * Schedules steps. Time that cannot be caught up is dropped: the simulation slows, and no step is
 * skipped.
 */
export class Pace {
  private debt = 0;
  private last: number | null = null;
  /** Simulated time per wall time. */
  speed = 1;

  /** `frame`: time of a step, s. `maxDebt`: time that may be owed, s. */
  constructor(
    readonly frame: number,
    readonly maxDebt: number,
  ) {}

  /** Takes the wall time, s. */
  advance(now: number): void {
    if (this.last !== null) {
      const due = this.speed * Math.max(0, now - this.last);
      this.debt = Math.min(this.debt + due, this.maxDebt * Math.max(1, this.speed));
    }
    this.last = now;
  }

  /** Returns true if a step is due, and counts it as taken. */
  take(): boolean {
    // A nanosecond of tolerance: sixty sums of 1/60 s must make sixty steps.
    if (this.debt + 1e-9 < this.frame) return false;
    this.debt -= this.frame;
    return true;
  }

  /** Returns the wall time until the next step is due, s. */
  wait(): number {
    return Math.max(0, this.frame - this.debt) / this.speed;
  }

  /** Resets the debt, as after a pause. */
  restart(): void {
    this.debt = 0;
    this.last = null;
  }
}

/** Simulated time per wall time and per time spent, over the last `window` seconds. */
export class Speedometer {
  private readonly marks: { wall: number; simulated: number; spent: number }[] = [];
  private simulated = 0;
  private spent = 0;

  constructor(readonly window = 1) {}

  /** Adds a step of `frame` seconds that took `cost` seconds and ended at wall time `now`, s. */
  add(now: number, frame: number, cost: number): void {
    this.simulated += frame;
    this.spent += cost;
    this.marks.push({ wall: now, simulated: this.simulated, spent: this.spent });
    while (this.marks.length > 2 && now - this.marks[1].wall >= this.window) this.marks.shift();
  }

  /** Simulated time per wall time; 1 before the first measurement. */
  factor(): number {
    const [first, last] = this.ends();
    return last && last.wall > first.wall ? (last.simulated - first.simulated) / (last.wall - first.wall) : 1;
  }

  /** Simulated time per time spent stepping; 1 before the first measurement. */
  capacity(): number {
    const [first, last] = this.ends();
    return last && last.spent > first.spent ? (last.simulated - first.simulated) / (last.spent - first.spent) : 1;
  }

  restart(): void {
    this.marks.length = 0;
  }

  private ends() {
    return [this.marks[0], this.marks.length > 1 ? this.marks[this.marks.length - 1] : undefined] as const;
  }
}

/** Interpolates between the last two states: 0 is the older one, 1 the newer one. */
export class Blend {
  private arrived = 0;
  /** Smoothed wall time between states, s. */
  private interval: number;

  constructor(frame: number) {
    this.interval = frame;
  }

  /** Takes the arrival of a state at wall time `now`, s. */
  arrive(now: number): void {
    const gap = now - this.arrived;
    // Neither states in a burst nor the first one after a pause measure the rate.
    if (gap > 1e-3 && gap < 0.25) this.interval += 0.1 * (gap - this.interval);
    this.arrived = now;
  }

  at(now: number): number {
    return Math.min(1, Math.max(0, (now - this.arrived) / this.interval));
  }
}

/** Events per second, over about a second. */
export class Rate {
  private readonly times: number[] = [];

  add(now: number): void {
    this.times.push(now);
    while (this.times.length > 2 && now - this.times[0] > 1) this.times.shift();
  }

  perSecond(): number {
    const n = this.times.length;
    const span = n > 1 ? this.times[n - 1] - this.times[0] : 0;
    return span > 0 ? (n - 1) / span : 0;
  }
}
