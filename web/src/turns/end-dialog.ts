// The end of a game: who won and why, the figures of it, and what comes next.

import type { PageStore } from '../app/state';
import type { TurnState, Update } from '../engine/game-protocol';
import { games } from '../messages';
import { after, nameOf, type Match } from '../modes/match';
import { outcomeLine } from '../modes/turns';
import { create } from '../ui/dom';
import { createToken } from './token';

export interface EndActions {
  /** Begins the next game of the match. */
  again(): void;
  /** Opens the menu. */
  other(): void;
  /** Plays the game again from its record. */
  watch(): void;
  /** Shares the last pull. */
  share(): void;
  /** Saves the game as a file. */
  save(): void;
  /** Height of the tower before the last turn, m. */
  height(): number;
}

export class EndDialog {
  private readonly dialog = create('dialog', { id: 'end', 'aria-labelledby': 'end-title' });
  /** Room for what is known later, such as the chance over time. */
  readonly more = create('div', { id: 'end-more' });

  constructor(
    private readonly store: PageStore,
    private readonly actions: EndActions,
  ) {
    document.body.append(this.dialog);
    store.subscribe(['world'], () => this.dialog.close());
  }

  get open(): boolean {
    return this.dialog.open;
  }

  close(): void {
    this.dialog.close();
  }

  /** Shows the end, and counts it in the match; `report` fills the room for what is known later. */
  show(report: (room: HTMLElement, match: Match) => void): void {
    const { frame, match } = this.store.state;
    const turn = frame?.update.turn;
    if (!turn?.outcome) return;
    const next = after(match, turn.outcome.winner, turn.outcome.loser);
    this.store.set({ match: next });
    this.more.replaceChildren();
    const { winner } = turn.outcome;
    this.dialog.replaceChildren(
      create(
        'header',
        {},
        winner === null ? '' : createToken(next, winner),
        create('h2', { id: 'end-title' }, outcomeLine(turn, next)),
      ),
      create('p', { class: 'reason' }, reasonOf(frame!.update, turn, next)),
      this.figures(turn, frame!.update, next),
      this.more,
      this.buttons(turn, next),
    );
    this.dialog.showModal();
    report(this.more, next);
  }

  private figures(turn: TurnState, update: Update, match: Match): HTMLElement {
    const { end } = games;
    const rows: [string, string][] = [
      [end.turns, String(Math.max(0, turn.number - 1))],
      [end.height, end.millimetres(Math.round(this.actions.height() * 1000))],
      [end.time, end.minutes(update.report.time)],
    ];
    if (turn.scores.length > 0) rows.unshift([end.points, String(turn.scores[0])]);
    const list = create('dl', {}, ...rows.map(([name, value]) => entry(name, value)));
    if (match.players.length > 1)
      list.append(...match.players.map((_, player) => entry(nameOf(match, player), wins(match, player))));
    return list;
  }

  private buttons(turn: TurnState, match: Match): HTMLElement {
    const { end } = games;
    const button = (id: string, label: string, action: () => void, main = false) => {
      const node = create('button', { id, class: main ? 'main' : 'plain', autofocus: main }, label);
      node.addEventListener('click', () => {
        this.dialog.close();
        action();
      });
      return node;
    };
    const first = create('div', { class: 'buttons' });
    first.append(button('end-again', end.again, () => this.actions.again(), true));
    first.append(button('end-other', end.other, () => this.actions.other()));
    const second = create('div', { class: 'buttons small' });
    second.append(button('end-watch', games.records.again, () => this.actions.watch()));
    second.append(button('end-share', games.records.share, () => this.actions.share()));
    second.append(button('end-save', games.records.save, () => this.actions.save()));
    second.append(button('end-view', end.view, () => undefined));
    const loser = turn.outcome?.loser ?? null;
    const next = match.players.length > 1 && loser !== null ? [end.begins(nameOf(match, loser))] : [];
    return create('div', {}, first, ...next.map(line => create('p', { class: 'note' }, line)), second);
  }
}

function wins(match: Match, player: number): string {
  return `${games.end.wins}: ${match.wins[player]}`;
}

function entry(name: string, value: string): HTMLElement {
  return create('div', {}, create('dt', {}, name), create('dd', {}, value));
}

function reasonOf({ fallen }: Update, { outcome, out }: TurnState, match: Match): string {
  const { end } = games;
  const loser = outcome?.loser ?? 0;
  if (fallen.length > 0)
    return match.players.length > 1 ? end.fell(nameOf(match, loser), fallen.length) : end.fellAlone(fallen.length);
  return out.includes(loser) ? end.gaveUp(nameOf(match, loser)) : end.stuck;
}
