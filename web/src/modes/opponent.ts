// Against the computer: it chooses by simulating, and moves with a hand like that of a person.

import { games } from '../messages';
import { matchOf, person, type Player } from './match';
import type { Mode } from './mode';
import { turnMode } from './turns';

const computer = (): Player => ({ name: games.menu.computer, strength: 'skilled' });

export const opponent: Mode = {
  ...turnMode,
  id: 'opponent',
  match: () => matchOf('opponent', 'official', [person(''), computer()]),
};
