// Delays of the engine: says when it takes long, until it answers.

import { text } from '../messages';
import type { Notice } from '../ui/notice';
import { Patience, type Awaited } from './patience';

/** Time between two checks, ms. */
const INTERVAL = 250;

/** Lines for the player. */
const DELAYS: Record<Awaited, string> = {
  engine: text.notices.slowEngine,
  world: text.notices.slowWorld,
  step: text.notices.slowStep,
};

export class Delays {
  private readonly patience = new Patience();
  private shown: Awaited | null = null;

  constructor(private readonly notice: Notice) {
    setInterval(() => this.check(), INTERVAL);
  }

  /** Begins to wait for the engine. */
  begin(awaited: Awaited): void {
    this.hide();
    this.patience.begin(awaited, now());
  }

  /** Ends the wait. */
  end(): void {
    this.hide();
    this.patience.end();
  }

  private check(): void {
    const late = this.patience.late(now());
    if (late === null || late === this.shown) return;
    this.shown = late;
    this.notice.hold(DELAYS[late]);
  }

  private hide(): void {
    if (this.shown) this.notice.release(DELAYS[this.shown]);
    this.shown = null;
  }
}

function now(): number {
  return performance.now() / 1000;
}
