// What all modes with turns say: whose turn it is, and what happens in it.

import type { GameEvent, TurnState, Update } from '../engine/game-protocol';
import { games } from '../messages';
import { nameOf, type Match } from './match';
import type { Mode, ModeUi } from './mode';

/** Status of a game with turns. */
export function turnStatus(update: Update, blocks: number, match: Match): string {
  const { turn } = update;
  if (!turn) return games.blocks(blocks);
  if (turn.phase === 'over') return outcomeLine(turn, match);
  return games.status(turn.number, blocks - update.fallen.length);
}

/** Line about the end of a game. */
export function outcomeLine({ outcome }: TurnState, match: Match): string {
  if (outcome === null) return '';
  const { winner, loser } = outcome;
  if (winner !== null) return games.wins(nameOf(match, winner));
  return match.players.length > 1 && loser !== null ? games.loses(nameOf(match, loser)) : games.over;
}

/** Says what a player has to know of an event. */
export function turnEvent(event: GameEvent, ui: ModeUi, match: Match): void {
  const several = match.players.length > 1;
  switch (event.event) {
    case 'turn_started':
      if (several) ui.notice(games.yourTurn(nameOf(match, event.player)));
      break;
    case 'illegal':
      ui.notice(games.illegal[event.rule.rule], 5);
      break;
    case 'refused':
      ui.notice(event.reason);
      break;
    case 'put_back':
      ui.notice(games.putBack);
      break;
    case 'timed_out':
      ui.notice(games.timedOut(nameOf(match, event.player)), 5);
      break;
    case 'resigned':
      if (several) ui.notice(games.resigned(nameOf(match, event.player)), 5);
      break;
  }
}

/** Parts that most modes with turns share. */
export const turnMode: Pick<Mode, 'rules' | 'overlay' | 'onEvent'> = {
  rules: () => ({ canTurn: true }),
  overlay: (update, blocks, match) => ({ status: turnStatus(update, blocks, match) }),
  onEvent: turnEvent,
};

/** Parts that modes for points share. */
export const pointsMode: typeof turnMode = {
  ...turnMode,
  onEvent(event, ui, match) {
    if (event.event === 'scored') ui.notice(games.scored(event.points));
    turnEvent(event, ui, match);
  },
};
