// Solo: one player builds as high as the tower bears, for points and height.

import { games } from '../messages';
import { matchOf, person } from './match';
import type { Mode } from './mode';
import { turnEvent, turnStatus } from './turns';

export const solo: Mode = {
  id: 'solo',
  match: () => matchOf('solo', 'solo', [person('')]),
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: turnStatus(update, blocks, match) }),
  onEvent(event, ui, match) {
    if (event.event === 'scored') ui.notice(games.scored(event.points));
    turnEvent(event, ui, match);
  },
};
