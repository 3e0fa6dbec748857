// Hot seat: one to eight players share the screen, and the tower judges.

import { matchOf, person } from './match';
import type { Mode } from './mode';
import { turnMode } from './turns';

export const hotSeat: Mode = {
  ...turnMode,
  id: 'hot-seat',
  match: () => matchOf('hot-seat', 'official', [person(''), person('')]),
};
