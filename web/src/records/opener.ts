// Opens records from files and links. None is believed before it was played again in a worker and
// came out the same.

import type { Play } from '../app/play';
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

  /** Plays a record again if it is true; null, with the reason on the page, where it is not. */
  async open(bytes: Uint8Array): Promise<Verified | null> {
    const verified = await this.verify(bytes);
    if (verified) this.play.replay(bytes, replayMatch(verified));
    return verified;
  }

  /** Plays a record again in a worker; null, with the reason on the page, where it is not true. */
  private async verify(bytes: Uint8Array): Promise<Verified | null> {
    const check = ++this.checks;
    const { records } = games;
    const progress = (part: number) => {
      if (check === this.checks) this.notice.hold(records.checking(Math.round(100 * part)));
    };
    progress(0);
    try {
      const verified = await this.play.pool.run({ kind: 'verify', bytes, seconds: SECONDS }, progress).result;
      if (verified.same) {
        this.notice.show(records.verified);
        return verified;
      }
      const { divergence, engine, own } = verified;
      this.notice.show(engine === own ? records.forged(divergence?.time_s ?? 0) : records.foreign(engine), LONG);
    } catch (error) {
      this.notice.show(records.none((error as Error).message), LONG);
    }
    return null;
  }
}
