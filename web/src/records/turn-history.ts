// The game at the start of each turn, so that turns can be taken back.

import type { PageStore } from '../app/state';
import type { Client } from '../engine/client';

/** Number of turns that can be taken back. */
const MAX_TURNS = 200;

interface TurnStart {
  turn: number;
  record: Uint8Array;
}

export class TurnHistory {
  private starts: TurnStart[] = [];

  /** `keeps`: true while turns can be taken back. */
  constructor(
    private readonly store: PageStore,
    private readonly client: Client,
    keeps: () => boolean,
  ) {
    store.subscribe(['world'], ({ world }) => {
      if (!world?.resumed) this.starts = [];
    });
    store.subscribe(['frame'], ({ frame, world }) => {
      if (!frame || !world || !keeps()) return;
      const started = frame.update.events.find(event => event.event === 'turn_started');
      if (started) void this.keep(started.number, world.world);
    });
  }

  /** True while there is something to take back. */
  get canUndo(): boolean {
    const turn = this.store.state.frame?.update.turn;
    if (!turn || this.starts.length === 0) return false;
    return turn.number > this.starts[0].turn || turn.phase !== 'choosing';
  }

  /** Returns the record of the start of the turn, or of the one before an untouched turn. */
  undo(): Uint8Array | null {
    const turn = this.store.state.frame?.update.turn;
    if (!turn || !this.canUndo) return null;
    if (turn.phase === 'choosing' && this.starts[this.starts.length - 1]?.turn === turn.number) this.starts.pop();
    return this.starts[this.starts.length - 1]?.record ?? null;
  }

  private async keep(turn: number, world: number): Promise<void> {
    const record = await this.client.ask({ what: 'record', state: true });
    if (!record || this.store.state.world?.world !== world) return;
    this.starts = [...this.starts.filter(start => start.turn < turn), { turn, record: record.bytes }].slice(-MAX_TURNS);
  }
}
