// What is known of a game some seconds after its end: the chance over time, and why the tower fell.

import type { Play } from '../app/play';
import { games } from '../messages';
import type { Match } from '../modes/match';
import type { LostContact, MoveChance, RecordReport } from '../study/jobs';
import { create } from '../ui/dom';
import { chancePlot } from './chance-plot';

/** Simulated time of the trials for each move, and longest time for all, s. */
const BUDGET = 60;
const SECONDS = 25;
/** Blocks of a row. */
const CELLS = 3;

/** Fills `room` with the analysis of the game that was played. */
export async function showAftermath(play: Play, room: HTMLElement, match: Match, turns: number): Promise<void> {
  const line = create('p', { class: 'note', role: 'status' });
  const progress = (part: number) => (line.textContent = games.plot.working(Math.round(100 * part)));
  progress(0);
  room.replaceChildren(line);
  try {
    const record = await play.client.ask({ what: 'record', state: false });
    if (!record) return room.replaceChildren();
    const budget = BUDGET * Math.max(1, turns);
    const job = { kind: 'record', bytes: record.bytes, budget, seconds: SECONDS } as const;
    const report = await play.pool.run(job, progress).result;
    room.replaceChildren(chancePlot(report, match), ...causeOf(report));
  } catch (error) {
    line.textContent = (error as Error).message;
  }
}

function causeOf({ fall, moves }: RecordReport): HTMLElement[] {
  const lost = fall?.first_lost;
  return lost ? [create('p', { class: 'note', id: 'end-cause' }, causeLine(lost, moves))] : [];
}

/** Names the contact that was lost first by the rows of its blocks. */
export function causeLine({ above, below }: LostContact, moves: readonly MoveChance[]): string {
  const { row, moved, table, cause } = games.plot;
  const name = (body: number) =>
    moves.some(move => move.body === body && !move.fell) ? moved : row(Math.floor(body / CELLS) + 1);
  return cause(name(above), below === null ? table : name(below));
}
