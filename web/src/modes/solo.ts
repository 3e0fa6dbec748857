// Solo: one player builds as high as the tower bears, for points and height.

import { matchOf, person } from './match';
import type { Mode } from './mode';
import { pointsMode } from './turns';

export const solo: Mode = {
  ...pointsMode,
  id: 'solo',
  match: () => matchOf('solo', 'solo', [person('')]),
};
