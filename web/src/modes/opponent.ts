// Against the computer: it chooses by simulating, and moves with a hand like that of a person.

import { games } from '../messages';
import { matchOf, person, type Player } from './match';
import type { Mode } from './mode';
import { turnEvent, turnStatus } from './turns';

const computer = (): Player => ({ name: games.menu.computer, strength: 'skilled' });

export const opponent: Mode = {
  id: 'opponent',
  match: () => matchOf('opponent', 'official', [person(''), computer()]),
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: turnStatus(update, blocks, match) }),
  onEvent: turnEvent,
};
