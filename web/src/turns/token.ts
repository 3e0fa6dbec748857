// Token of a player: a disc with the first letter of the name, and a pattern of its own, so that
// colour is never the only cue.

import { nameOf, type Match } from '../modes/match';
import { create } from '../ui/dom';

export function createToken(match: Match, player: number): HTMLElement {
  const letter = Array.from(nameOf(match, player).trim())[0] ?? '';
  const shown = match.players[player]?.name ? letter.toUpperCase() : String(player + 1);
  return create('span', { class: 'token', 'data-player': player, 'aria-hidden': 'true' }, shown);
}
