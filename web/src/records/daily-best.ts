// The best game on the tower of the day: stored, named at the start, and shown as a ghost.

import type { Play } from '../app/play';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import { games } from '../messages';
import { dayOf } from '../modes/daily';
import type { Notice } from '../ui/notice';
import { Bodies } from '../view/bodies';
import { Ghost } from '../view/ghost';
import type { BestGame, Storage } from './storage';

/** Distance for the opacity of the ghost, m. */
const FAINT = 0.0012;

export class DailyBest {
  private readonly ghost = new Ghost();
  /** Poses at the end of the last turn in which the tower stood, and its height, m. */
  private stood: { poses: Float32Array; height: number } | null = null;

  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly play: Play,
    private readonly storage: Promise<Storage | null>,
    private readonly notice: Notice,
  ) {
    stage.view.add(this.ghost.group);
    store.subscribe(['dark'], ({ dark }) => this.ghost.setDark(dark));
    store.subscribe(['world'], () => void this.begin());
    store.subscribe(['frame'], ({ frame }) => {
      if (!this.isPlayed || !frame?.update.events.some(({ event }) => event === 'settled')) return;
      this.stood = { poses: frame.poses.slice(), height: stage.bodies!.top() };
    });
  }

  /** Stores the game where it is the best of the day. */
  async finish(): Promise<void> {
    const turn = this.store.state.frame?.update.turn;
    const { stood } = this;
    if (!this.isPlayed || !turn || !stood) return;
    const [storage, record] = [await this.storage, await this.play.client.ask({ what: 'record', state: false })];
    const game = { key: this.key, points: turn.scores[0], height: stood.height, poses: stood.poses };
    const before = await storage?.best(this.key).catch(() => undefined);
    if (!record || !storage || (before && !isBetter(game, before))) return;
    await storage.saveBest({ ...game, record: record.bytes }).catch(() => this.notice.show(games.records.notKept));
  }

  private get isPlayed(): boolean {
    return this.store.state.match.mode === 'daily';
  }

  private get key(): string {
    return `daily ${dayOf(new Date())}`;
  }

  private async begin(): Promise<void> {
    this.stood = null;
    this.ghost.hide();
    this.stage.view.invalidate();
    const { world } = this.store.state;
    if (!this.isPlayed || !world || world.frames !== null) return;
    const best = await (await this.storage)?.best(this.key).catch(() => undefined);
    if (this.store.state.world !== world) return;
    this.notice.show(best ? games.daily.best(best.points, Math.round(best.height * 1000)) : games.daily.first, 6);
    if (!best || best.poses.length !== world.poses.length) return;
    const bodies = new Bodies(world.sizes, best.poses);
    this.ghost.show(bodies, new Float32Array(bodies.count).fill(FAINT));
    this.stage.view.invalidate();
  }
}

function isBetter(game: Omit<BestGame, 'record'>, than: BestGame): boolean {
  return game.points > than.points || (game.points === than.points && game.height > than.height);
}
