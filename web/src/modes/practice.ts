// Practice: turns by the rules, and each of them can be taken back.

import { matchOf, person } from './match';
import type { Mode } from './mode';
import { turnEvent, turnStatus } from './turns';

export const practice: Mode = {
  id: 'practice',
  undo: true,
  match: () => matchOf('practice', 'official', [person('')]),
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: turnStatus(update, blocks, match) }),
  onEvent: turnEvent,
};
