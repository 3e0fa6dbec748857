// Games that the browser keeps, in IndexedDB: the unfinished game of each tab, the best games, and
// those of others on the tower of a day.

import { openDB, type DBSchema, type IDBPDatabase } from 'idb';
import type { Settings } from '../app/state';
import type { Match } from '../modes/match';

const NAME = 'teeter';
const VERSION = 2;
/** Number of unfinished games that are stored, and of those of others on one tower. */
const MAX_GAMES = 8;
const MAX_RIVALS = 50;

/** An unfinished game. */
export interface SavedGame {
  /** Tab that plays it. */
  tab: string;
  /** Time of the day at which it was saved, ms since 1970. */
  at: number;
  /** Query of the address that it is played at. */
  search: string;
  match: Match;
  settings: Settings;
  /** Number of the turn; 0 in free play. */
  turn: number;
  /** Its record, with its state. */
  record: Uint8Array;
}

/** Score of a game, and how it is shown. */
export interface Scored {
  points: number;
  /** Height of the tower, m. */
  height: number;
  record: Uint8Array;
  /** Poses of its blocks when it stood last, seven numbers per body as in a frame. */
  poses: Float32Array;
}

/** The best game of a kind. */
export interface BestGame extends Scored {
  key: string;
}

/** Game of somebody else, which was played again and is true. */
export interface RivalGame extends Scored {
  /** Name of the tower that it was played on. */
  tower: string;
  name: string;
}

interface Schema extends DBSchema {
  games: { key: string; value: SavedGame; indexes: { at: number } };
  best: { key: string; value: BestGame };
  rivals: { key: number; value: RivalGame; indexes: { tower: string } };
}

export class Storage {
  private constructor(private readonly db: IDBPDatabase<Schema>) {}

  /** Opens the storage; null where the browser keeps nothing. */
  static async open(): Promise<Storage | null> {
    try {
      const db = await openDB<Schema>(NAME, VERSION, {
        upgrade(db, before) {
          if (before < 1) {
            db.createObjectStore('games', { keyPath: 'tab' }).createIndex('at', 'at');
            db.createObjectStore('best', { keyPath: 'key' });
          }
          db.createObjectStore('rivals', { autoIncrement: true }).createIndex('tower', 'tower');
        },
        // Another tab with a newer page waits for this one.
        blocking: (_current, _blocked, event) => (event.target as IDBDatabase).close(),
      });
      return new Storage(db);
    } catch {
      return null;
    }
  }

  /** Saves a game. Where there is no room, older ones make it. Throws where it cannot be saved. */
  async save(game: SavedGame): Promise<void> {
    try {
      await this.db.put('games', game);
    } catch (error) {
      if (!(error instanceof DOMException) || error.name !== 'QuotaExceededError') throw error;
      await this.prune(game.tab, 0);
      await this.db.put('games', game);
    }
    await this.prune(game.tab, MAX_GAMES - 1);
  }

  /** Returns the game of a tab. */
  game(tab: string): Promise<SavedGame | undefined> {
    return this.db.get('games', tab);
  }

  /** Returns the game that was saved last. */
  async newest(): Promise<SavedGame | null> {
    const cursor = await this.db.transaction('games').store.index('at').openCursor(null, 'prev');
    return cursor?.value ?? null;
  }

  remove(tab: string): Promise<void> {
    return this.db.delete('games', tab);
  }

  best(key: string): Promise<BestGame | undefined> {
    return this.db.get('best', key);
  }

  async saveBest(game: BestGame): Promise<void> {
    await this.db.put('best', game);
  }

  /** Returns the games of others on a tower. */
  rivals(tower: string): Promise<RivalGame[]> {
    return this.db.getAllFromIndex('rivals', 'tower', tower);
  }

  /** Saves a game of somebody else, and drops those on other towers. */
  async saveRival(game: RivalGame): Promise<void> {
    const { store, done } = this.db.transaction('rivals', 'readwrite');
    let left = MAX_RIVALS - 1;
    for (let cursor = await store.openCursor(null, 'prev'); cursor; cursor = await cursor.continue()) {
      if (cursor.value.tower === game.tower && left > 0) left -= 1;
      else await cursor.delete();
    }
    await Promise.all([store.add(game), done]);
  }

  /** Deletes the oldest games, so that `kept` are left besides that of `tab`. */
  private async prune(tab: string, kept: number): Promise<void> {
    const { store, done } = this.db.transaction('games', 'readwrite');
    let left = kept;
    for (let cursor = await store.index('at').openCursor(null, 'prev'); cursor; cursor = await cursor.continue()) {
      if (cursor.value.tab === tab) continue;
      if (left > 0) left -= 1;
      else await cursor.delete();
    }
    await done;
  }
}
