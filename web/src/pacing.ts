// Time: how many steps are due, how fast simulated time runs, and where between two states the picture is.

/** Says when a step is due. Time that cannot be caught up is dropped: the simulation slows, and no step is ever skipped. */
export class Pace {
  private debt = 0;
  private last: number | null = null;

  /** `frame`: time of a step, s. `mostDebt`: time that may be owed, s. */
  constructor(
    readonly frame: number,
    readonly mostDebt: number,
  ) {}

  /** Tells the wall time, s. */
  advance(now: number): void {
    if (this.last !== null) this.debt = Math.min(this.debt + Math.max(0, now - this.last), this.mostDebt);
    this.last = now;
  }

  /** Whether a step is due; it counts as taken. */
  take(): boolean {
    // A nanosecond of tolerance: sixty sums of 1/60 s must make sixty steps.
    if (this.debt + 1e-9 < this.frame) return false;
    this.debt -= this.frame;
    return true;
  }

  /** Time until the next step is due, s. */
  wait(): number {
    return Math.max(0, this.frame - this.debt);
  }

  /** Forgets the time that has passed: after a pause nothing is owed. */
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

  /** One step that covered `frame` seconds and took `cost` seconds, ended at wall time `now`. */
  add(now: number, frame: number, cost: number): void {
    this.simulated += frame;
    this.spent += cost;
    this.marks.push({ wall: now, simulated: this.simulated, spent: this.spent });
    while (this.marks.length > 2 && now - this.marks[1].wall >= this.window) this.marks.shift();
  }

  /** Simulated time per wall time; 1 until there is something to measure. */
  factor(): number {
    const [first, last] = this.ends();
    return last && last.wall > first.wall ? (last.simulated - first.simulated) / (last.wall - first.wall) : 1;
  }

  /** Simulated time per time spent stepping; 1 until there is something to measure. */
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

/** Place of the picture between the last two states: 0 the older, 1 the newer. */
export class Blend {
  private arrived = 0;
  /** Smoothed wall time between states, s. */
  private interval: number;

  constructor(frame: number) {
    this.interval = frame;
  }

  /** A state came at wall time `now`, s. */
  arrive(now: number): void {
    const gap = now - this.arrived;
    // States that come in a burst say nothing about the rate, nor does the first after a pause.
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
