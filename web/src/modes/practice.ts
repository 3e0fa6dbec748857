// Practice: turns by the rules, and each of them can be taken back.

import { matchOf, person } from './match';
import type { Mode } from './mode';
import { turnMode } from './turns';

export const practice: Mode = {
  ...turnMode,
  id: 'practice',
  undo: true,
  match: () => matchOf('practice', 'official', [person('')]),
};
