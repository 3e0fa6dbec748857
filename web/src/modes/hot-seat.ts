// Hot seat: one to eight players share the screen, and the tower judges.

import { matchOf, person } from './match';
import type { Mode } from './mode';
import { turnEvent, turnStatus } from './turns';

export const hotSeat: Mode = {
  id: 'hot-seat',
  match: () => matchOf('hot-seat', 'official', [person(''), person('')]),
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: turnStatus(update, blocks, match) }),
  onEvent: turnEvent,
};
