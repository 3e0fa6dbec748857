// The loop of a worker: one step after another, in step with the wall clock, with messages handled
// in between.

import { FRAME } from './game-protocol';
import { Pace } from './pacing';

/** Time that may be owed before simulated time slows, s: bridges a hiccup of the machine. */
const MAX_DEBT = 4 * FRAME;

export class Loop {
  private readonly pace = new Pace(FRAME, MAX_DEBT);
  // A message to oneself returns at once, but after those of the page: no command starves, and no
  // timer is clamped to 4 ms.
  private readonly soon = new MessageChannel();
  private timer: number | null = null;
  private queued = false;

  /**
   * `now`: wall clock, s. `runs`: true while there is something to step. `guard` runs an action
   * that may throw.
   */
  constructor(
    private readonly now: () => number,
    private readonly runs: () => boolean,
    private readonly step: () => void,
    private readonly guard: (action: () => void) => void,
  ) {
    this.soon.port1.onmessage = () => {
      this.queued = false;
      this.guard(() => this.tick());
    };
  }

  /** Sets the simulated time per wall time. */
  setSpeed(speed: number): void {
    this.pace.advance(this.now());
    this.pace.speed = speed;
    // A timer may wait for longer than the next step is away now.
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.schedule();
  }

  /** Starts again; the time that has passed is not owed. */
  restart(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
    this.pace.restart();
    this.pace.advance(this.now());
    this.schedule();
  }

  private tick(): void {
    this.timer = null;
    if (!this.runs()) return;
    this.pace.advance(this.now());
    if (this.pace.take()) this.step();
    this.schedule();
  }

  private schedule(): void {
    if (!this.runs() || this.timer !== null || this.queued) return;
    const wait = this.pace.wait() * 1000;
    if (wait < 1) {
      this.queued = true;
      this.soon.port2.postMessage(null);
    } else {
      this.timer = self.setTimeout(() => this.guard(() => this.tick()), wait);
    }
  }
}
