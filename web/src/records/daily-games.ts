// The tower of the day among players: its ranking, its ghost, and games of others that come as
// files or links.

import type { Play } from '../app/play';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import { games } from '../messages';
import type { Verified } from '../study/jobs';
import type { Notice } from '../ui/notice';
import { DailyBest } from './daily-best';
import { DailyRanking } from './daily-ranking';
import { RankDialog } from './rank-dialog';
import { rankingList } from './ranking-list';
import type { Storage } from './storage';

/** Duration of the line about a ranked game, s. */
const LONG = 8;

export class DailyGames {
  private readonly ranking: DailyRanking;
  private readonly best: DailyBest;
  private readonly dialog = new RankDialog();

  /** `watch` plays a record on the page. */
  constructor(
    { store, stage, play }: { store: PageStore; stage: Stage; play: Play },
    storage: Promise<Storage | null>,
    private readonly notice: Notice,
    private readonly watch: (record: Uint8Array) => void,
  ) {
    this.ranking = new DailyRanking(storage);
    this.best = new DailyBest(store, stage, play, this.ranking, notice);
  }

  /** Offers to rank a game on the tower of today; returns true where the player watches it. */
  async offer(record: Uint8Array, verified: Verified, file: string): Promise<boolean> {
    const choice = await this.dialog.ask(verified, file);
    if (choice === null || choice === 'watch') return choice === 'watch';
    try {
      const rank = await this.ranking.add(choice.name, record, verified);
      const { length } = await this.ranking.list();
      this.notice.show(games.daily.ranked(choice.name, rank, length), LONG);
      await this.best.show();
    } catch {
      this.notice.show(games.daily.notRanked, LONG);
    }
    return false;
  }

  /** Fills a room with the ranking; `left` is called before a game of it is watched. */
  async fill(room: HTMLElement, left: () => void): Promise<void> {
    const list = await this.ranking.list();
    const watch = (game: { record: Uint8Array }) => {
      left();
      this.watch(game.record);
    };
    room.replaceChildren(rankingList(list, watch));
  }

  /** Poses of the ghost; null where none is shown. */
  get ghost(): Float32Array | null {
    return this.best.shown;
  }

  /** Stores the game of the player where it is the best of the day. */
  finish(): Promise<void> {
    return this.best.finish();
  }
}
