// The games on the tower of the day: the best of the player and those of others, the best first.

import { dayOf } from '../modes/daily';
import type { Verified } from '../study/jobs';
import type { BestGame, Scored, Storage } from './storage';

/** A game on the tower of the day. */
export interface Ranked extends Scored {
  /** Name of the player; null for the one at this page. */
  name: string | null;
}

export class DailyRanking {
  constructor(private readonly storage: Promise<Storage | null>) {}

  /** Returns all games on the tower of today. */
  async list(): Promise<Ranked[]> {
    const storage = await this.storage;
    const own = await storage?.best(this.tower).catch(() => undefined);
    const rivals = (await storage?.rivals(this.tower).catch(() => [])) ?? [];
    const games = [...(own ? [{ ...own, name: null }] : []), ...rivals];
    return games.sort((a, b) => (isBetter(a, b) ? -1 : isBetter(b, a) ? 1 : 0));
  }

  /**
   * Adds the record of somebody else, which is true and begins on the tower of today, unless it is
   * there. Returns its rank, from 1. Throws where nothing is kept.
   */
  async add(name: string, record: Uint8Array, { turn, height, poses }: Verified): Promise<number> {
    const rank = async () => 1 + (await this.list()).findIndex(game => isSame(game.record, record));
    const before = await rank();
    if (before > 0) return before;
    const storage = await this.storage;
    if (!storage) throw new Error('nothing is kept');
    await storage.saveRival({ tower: this.tower, name, points: turn?.scores[0] ?? 0, height, record, poses });
    return rank();
  }

  /** Stores a game of the player where it is the best. Throws where nothing is kept. */
  async finish(game: Omit<BestGame, 'key'>): Promise<void> {
    const storage = await this.storage;
    if (!storage) throw new Error('nothing is kept');
    const before = await storage.best(this.tower).catch(() => undefined);
    if (!before || isBetter(game, before)) await storage.saveBest({ ...game, key: this.tower });
  }

  private get tower(): string {
    return `daily ${dayOf(new Date())}`;
  }
}

function isBetter(game: Scored, than: Scored): boolean {
  return game.points > than.points || (game.points === than.points && game.height > than.height);
}

function isSame(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, index) => byte === b[index]);
}
