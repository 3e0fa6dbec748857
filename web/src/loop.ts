// The loop of a worker: one step after the other, in step with the wall clock and open to messages between them.

import { Pace } from './pacing';
import { FRAME } from './protocol';

/** Time that may be owed before simulated time slows, s: rides out a hiccup of the machine. */
const MOST_DEBT = 4 * FRAME;

export class Loop {
  private readonly pace = new Pace(FRAME, MOST_DEBT);
  // A message to oneself comes back at once but after the messages of the page: a hand is never starved, and no timer is clamped to 4 ms.
  private readonly soon = new MessageChannel();
  private timer: number | null = null;
  private queued = false;

  /** `now`: the wall clock, s. `runs`: whether there is anything to step. `guard` runs what may fail. */
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

  /** Begins anew: of the time that has passed nothing is owed. */
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
