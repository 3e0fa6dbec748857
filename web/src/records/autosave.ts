// Saves the game as it goes on, so that a closed page loses nothing.

import type { Client } from '../engine/client';
import type { PageStore } from '../app/state';
import type { GameEvent } from '../engine/game-protocol';
import type { SavedGame, Storage } from './storage';

/** Time between two saves while the tower moves, ms. */
const INTERVAL = 4000;
/** Events after which the game is saved. */
const SAVING: readonly GameEvent['event'][] = ['turn_started', 'placed', 'removed', 'released'];

export class Autosave {
  /** Simulated time of the game that was saved last, s. */
  saved = 0;
  private savedAt = 0;
  private saving = false;
  private again = false;
  private complained = false;

  /** `storage`: null where the browser keeps nothing. `lost` says that the game is not kept. */
  constructor(
    private readonly store: PageStore,
    private readonly client: Client,
    private readonly storage: Storage | null,
    private readonly tab: string,
    private readonly lost: () => void,
  ) {
    store.subscribe(['frame'], () => this.follow());
    store.subscribe(['paused'], ({ paused }) => paused && void this.save());
    document.addEventListener('visibilitychange', () => document.hidden && void this.save());
    window.addEventListener('pagehide', () => void this.save());
  }

  private follow(): void {
    const { frame } = this.store.state;
    if (!frame) return;
    const { events, report, turn } = frame.update;
    const isTurn = events.some(({ event }) => SAVING.includes(event));
    const isOver = turn?.phase === 'over' && events.some(({ event }) => event === 'lost');
    const moves = report.awake > 0 || frame.update.hand !== null;
    if (isTurn || isOver || (moves && Date.now() - this.savedAt > INTERVAL)) void this.save();
  }

  /** Saves the game now, or once the present save has ended. */
  async save(): Promise<void> {
    const { frame, world, watching } = this.store.state;
    // The hand of a computer player cannot be taken over: its turn is begun again.
    if (watching && frame?.update.hand && frame.update.turn?.phase !== 'over') return;
    // A tower that nobody has touched is built again by its seed.
    if (!frame || !world || (frame.update.report.time < 1 && !frame.update.hand)) return;
    if (this.saving) {
      this.again = true;
      return;
    }
    this.saving = true;
    this.savedAt = Date.now();
    try {
      await this.write(world.world);
    } catch {
      this.complain();
    }
    this.saving = false;
    if (this.again) {
      this.again = false;
      await this.save();
    }
  }

  private async write(world: number): Promise<void> {
    if (!this.storage) return this.complain();
    const { frame, match, settings } = this.store.state;
    // Whoever watches a record can come back to the game.
    if (match.mode === 'replay') return;
    const turn = frame?.update.turn;
    if (turn?.phase === 'over') return this.storage.remove(this.tab);
    const record = await this.client.ask({ what: 'record', state: true });
    if (!record || this.store.state.world?.world !== world) return;
    const game: SavedGame = {
      tab: this.tab,
      at: Date.now(),
      search: location.search,
      match,
      settings,
      turn: turn?.number ?? 0,
      record: record.bytes,
    };
    await this.storage.save(game);
    this.saved = record.time;
  }

  /** Says once, in a game that would be missed, that it is not kept. */
  private complain(): void {
    if (this.complained || !this.store.state.frame?.update.turn) return;
    this.complained = true;
    this.lost();
  }
}
