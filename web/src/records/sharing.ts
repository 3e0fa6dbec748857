// Shares what was played: the last pull as a link, the game as a file.

import type { Play } from '../app/play';
import type { PageStore } from '../app/state';
import { games } from '../messages';
import type { Notice } from '../ui/notice';
import { fileName, saveFile } from './files';
import { linkOf, MAX_LINK } from './link';
import { share } from './share';

/** Longest time in which a move is played again, s. */
const SECONDS = 60;
const LONG = 8;

export class Sharing {
  constructor(
    private readonly store: PageStore,
    private readonly play: Play,
    private readonly notice: Notice,
  ) {}

  /** Saves the game so far, or the record that is played again, as a file. */
  async save(replayed: Uint8Array | null): Promise<void> {
    const record = replayed ?? (await this.play.client.ask({ what: 'record', state: false }))?.bytes;
    if (record) saveFile(record, fileName(this.store.state.frame?.update.turn?.number ?? 0));
  }

  /** Shares the last pull as a link. */
  async shareMove(): Promise<void> {
    const { records } = games;
    const move = await this.play.client.ask({ what: 'move' });
    if (!move || move.commands.length === 0) return this.notice.show(records.nothingToShare);
    const cut = await this.play.pool.run({ kind: 'cut', move, seconds: SECONDS }).result;
    if (!cut.same) return this.notice.show(records.differs, LONG);
    const link = linkOf(cut.bytes, location.href);
    if (link.length > MAX_LINK) {
      this.notice.show(records.tooLong((cut.bytes.length / 1000).toFixed(1)), LONG);
      return saveFile(cut.bytes, fileName(1));
    }
    await this.send(link);
  }

  private async send(link: string): Promise<void> {
    const { records } = games;
    const shared = await share(records.shareTitle, link);
    if (shared === 'copied') this.notice.show(records.copied, LONG);
    // Any browser can copy the address of the page.
    if (shared === 'refused') {
      history.replaceState(null, '', link);
      this.notice.show(records.cannotCopy, LONG);
    }
  }
}
