// Opens records from files and links. None is believed before it was played again in a worker and
// came out the same; one whose engine is missing is shown as what it is.

import { enginesAddress } from '../app/engines';
import type { Play } from '../app/play';
import type { Setup } from '../engine/protocol';
import { games } from '../messages';
import { replayMatch } from '../modes/replay';
import type { Verified } from '../study/jobs';
import type { Notice } from '../ui/notice';

/** Longest time of the check, s. */
const SECONDS = 900;
/** Duration of a line that refuses a record, s. */
const LONG = 10;

export class Opener {
  private checks = 0;

  constructor(
    private readonly play: Play,
    private readonly notice: Notice,
  ) {}

  /** Plays a record on the page. */
  show(bytes: Uint8Array, verified: Verified): void {
    this.play.replay(bytes, replayMatch(verified));
  }

  /**
   * Plays a record again in a worker, and compares its beginning with that of a setup; null, with
   * the reason on the page, where it is not true.
   */
  async verify(bytes: Uint8Array, setup: Setup): Promise<Verified | null> {
    const check = ++this.checks;
    const { records } = games;
    const progress = (part: number) => {
      if (check === this.checks) this.notice.hold(records.checking(Math.round(100 * part)));
    };
    progress(0);
    try {
      const job = { kind: 'verify', bytes, engines: enginesAddress(), setup, seconds: SECONDS } as const;
      const verified = await this.play.pool.run(job, progress).result;
      const { same, divergence, engine } = verified;
      if (same) this.notice.show(records.verified);
      else if (same === null) this.notice.show(records.unchecked(engine), LONG);
      else this.notice.show(records.forged(divergence?.time_s ?? 0), LONG);
      return same === false ? null : verified;
    } catch (error) {
      this.notice.show(records.none((error as Error).message), LONG);
    }
    return null;
  }
}
