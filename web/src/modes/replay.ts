// Replay: a recorded game, which the page only watches.

import { games } from '../messages';
import type { Verified } from '../study/jobs';
import { matchOf, person, type Match } from './match';
import type { Mode } from './mode';
import { turnStatus } from './turns';

export const replay: Mode = {
  id: 'replay',
  watches: true,
  match: () => matchOf('replay', 'free', [person('')]),
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: `${games.modes.replay.name} · ${turnStatus(update, blocks, match)}` }),
  onEvent: () => undefined,
};

/** Match that a record is shown as. */
export function replayMatch({ rules }: Verified): Match {
  return matchOf(
    'replay',
    rules.table,
    Array.from({ length: rules.players }, () => person('')),
  );
}
