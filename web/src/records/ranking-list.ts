// The list of the games on the tower of the day.

import { games } from '../messages';
import { create, icon } from '../ui/dom';
import type { Ranked } from './daily-ranking';

/** Creates the list; `watch` plays a game of it again. */
export function rankingList(ranked: readonly Ranked[], watch: (game: Ranked) => void): HTMLElement {
  const { daily } = games;
  const list = create('ol', { class: 'ranking' }, ...ranked.map((game, index) => entry(game, index + 1, watch)));
  const hint = create('p', { class: 'note' }, ranked.length > 0 ? daily.addHint : daily.firstHint);
  return create('section', { 'aria-label': daily.ranking }, create('h3', {}, daily.ranking), list, hint);
}

function entry(game: Ranked, rank: number, watch: (game: Ranked) => void): HTMLElement {
  const { daily } = games;
  const name = game.name ?? daily.you;
  const play = create('button', {
    class: 'plain',
    type: 'button',
    title: daily.watch(name),
    'aria-label': daily.watch(name),
  });
  play.append(icon('i-play'));
  play.addEventListener('click', () => watch(game));
  // The player's own game was computed here.
  const mark = create('abbr', {
    class: 'checked',
    title: daily.checkedTitle,
    role: 'img',
    'aria-label': daily.checked,
  });
  mark.textContent = '✓';
  return create(
    'li',
    { class: game.name === null ? 'own' : null },
    create('span', { class: 'rank' }, `${rank}.`),
    create('span', { class: 'name' }, name, ...(game.name === null ? [] : [' ', mark])),
    create('span', { class: 'score' }, daily.score(game.points, Math.round(game.height * 1000))),
    play,
  );
}
