// The card of the turn: whose it is, what to do in it, the time left, points, and all players.

import type { PageState, PageStore } from '../app/state';
import type { TurnState } from '../engine/game-protocol';
import type { Rules } from '../engine/protocol';
import { games } from '../messages';
import { nameOf, type Match } from '../modes/match';
import { outcomeLine } from '../modes/turns';
import { create, element, icon, setText } from '../ui/dom';
import { createToken } from './token';

export interface TurnActions {
  /** Shows the safest block. */
  hint(): void;
  /** Takes the last turn back. */
  undo(): void;
  /** True while there is a turn to take back. */
  canUndo(): boolean;
  /** Height of the tower, m. */
  height(): number;
}

/** Name of the player whose turn it is; that of the mode for one who plays alone and gave none. */
function headingOf(match: Match, player: number): string {
  const isAlone = match.players.length === 1 && !match.players[0].name;
  const mode = games.modes[match.mode as keyof typeof games.modes];
  return isAlone && mode ? mode.name : nameOf(match, player);
}

export class TurnCard {
  private readonly card = create('section', { id: 'turn', 'aria-label': games.turn.label, hidden: true });
  private readonly token = create('span', { class: 'now' });
  private readonly name = create('b', { id: 'turn-name' });
  private readonly step = create('span', { id: 'turn-step' });
  private readonly clock = create('span', { id: 'turn-clock' });
  private readonly points = create('span');
  private readonly height = create('span');
  private readonly score = create('span', { id: 'turn-score', hidden: true }, this.points, this.height);
  private readonly players = create('ol', { id: 'turn-players' });
  private readonly undo = create('button', { id: 'undo', title: games.turn.undo, 'aria-label': games.turn.undo });
  private readonly hint = create('button', { id: 'hint', title: games.hints.title }, games.hints.toggle);
  private readonly win = create('span', { id: 'turn-win', hidden: true });
  private shown = '';

  /** `undo`: true in a mode in which turns can be taken back. */
  constructor(
    store: PageStore,
    private readonly actions: TurnActions,
    private readonly undoes: (state: Readonly<PageState>) => boolean,
  ) {
    this.undo.append(icon('i-left'));
    this.hint.addEventListener('click', () => actions.hint());
    this.undo.addEventListener('click', () => actions.undo());
    const words = create('p', {}, this.name, this.step);
    this.card.append(this.token, words, this.clock, this.score, this.players, this.win, this.hint, this.undo);
    element('stage').after(this.card);
    store.subscribe(['frame', 'match', 'thinking', 'safest'], state => this.show(state));
  }

  private show(state: Readonly<PageState>): void {
    const { frame, match, world } = state;
    const turn = frame?.update.turn;
    this.card.hidden = !turn;
    document.body.classList.toggle('turns', turn !== undefined);
    if (!turn || !world?.rules) return;
    this.showPlayers(turn, match);
    const isOver = turn.phase === 'over';
    setText(this.name, isOver ? outcomeLine(turn, match) : headingOf(match, turn.player));
    const { thinking } = state;
    setText(this.step, thinking === null ? stepOf(turn, world.rules) : games.turn.thinking);
    this.showClock(turn, world.rules);
    this.step.classList.toggle('thinking', thinking !== null);
    this.step.style.setProperty('--part', String(thinking ?? 0));
    const points = turn.scores[turn.player];
    this.score.hidden = points === undefined;
    if (points !== undefined) {
      setText(this.points, games.turn.points(points));
      setText(this.height, games.turn.height(Math.round(this.actions.height() * 1000)));
    }
    this.showHint(turn, state);
    this.undo.hidden = !this.undoes(state);
    this.undo.disabled = !this.actions.canUndo();
  }

  /** A bar of the chance that the tower stands after the safest pull. */
  private showHint({ phase }: TurnState, { safest, watching, match }: Readonly<PageState>): void {
    this.hint.hidden = watching || phase !== 'choosing' || match.mode === 'daily';
    this.win.hidden = safest === null;
    if (safest === null) return;
    const chance = 1 - safest.chance;
    setText(this.win, games.hints.bar(Math.round(100 * chance)));
    this.win.style.setProperty('--part', String(chance));
  }

  /** A clock shows whole seconds, and fills a bar as time goes. */
  private showClock({ left_s, phase }: TurnState, { turn_s }: Rules): void {
    this.clock.hidden = left_s === null || turn_s === null || phase === 'settling' || phase === 'over';
    if (this.clock.hidden) return;
    setText(this.clock, games.turn.clock(Math.ceil(left_s!)));
    this.clock.style.setProperty('--part', String(left_s! / turn_s!));
    this.clock.classList.toggle('short', left_s! < 10);
  }

  private showPlayers(turn: TurnState, match: Match): void {
    const player = turn.outcome?.winner ?? turn.player;
    const shown = JSON.stringify([player, turn.out, match.players, match.wins]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.token.replaceChildren(createToken(match, player));
    this.players.hidden = match.players.length < 2;
    this.players.replaceChildren(
      ...match.players.map((_, other) => {
        const current = other === player ? 'true' : null;
        const out = turn.out.includes(other);
        const name = create('span', { class: 'name' }, nameOf(match, other));
        return create('li', { 'aria-current': current, class: out ? 'out' : null }, createToken(match, other), name);
      }),
    );
  }
}

/** Words for what the player does now. */
function stepOf(turn: TurnState, { settle_s }: Rules): string {
  const { phase } = turn;
  if (phase === 'settling') return games.turn.settling(settle_s);
  if (phase === 'choosing' && turn.throw) {
    const { thrown, die } = games.turn;
    return die(thrown[turn.throw.cell], thrown[turn.throw.row]);
  }
  return games.turn[phase];
}
