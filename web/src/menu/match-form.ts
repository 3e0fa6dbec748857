// The players and the rules of a match.

import { ROWS } from '../app/url';
import type { TableName } from '../engine/protocol';
import { games } from '../messages';
import { matchOf, MAX_PLAYERS, person, STRENGTHS, TABLES, type Match, type Strength } from '../modes/match';
import { createToken } from '../turns/token';
import { create } from '../ui/dom';

/** Modes in which the players choose a table of rules, and their number. */
const WITH_RULES = ['hot-seat', 'opponent', 'practice'];
const WITH_PLAYERS = ['hot-seat'];
/** Modes whose tower is given. */
const WITH_TOWER = ['daily'];

export class MatchForm {
  readonly node = create('form', { id: 'match', method: 'dialog' });
  private match: Match = matchOf('free', 'free', [person('')]);
  private readonly players = create('fieldset', { id: 'match-players' });
  private readonly table = create('select', { id: 'match-table', 'aria-describedby': 'match-table-note' });
  private readonly note = create('p', { id: 'match-table-note', class: 'note' });
  private readonly rules = create('div', {}, create('label', {}, games.menu.rules, this.table), this.note);
  private readonly strength = create('select', { id: 'match-strength' });
  private readonly strengthLabel = create('label', {}, games.menu.strength, this.strength);
  private readonly rows = create('input', { id: 'match-rows', type: 'range', min: ROWS.min, max: ROWS.max, step: 1 });
  private readonly rowsValue = create('output', {});
  private readonly rowsLabel = create('label', {}, games.menu.rows, this.rowsValue, this.rows);

  constructor(begin: (match: Match, rows: number) => void) {
    this.table.append(...TABLES.map(table => new Option(games.tables[table].name, table)));
    this.table.addEventListener('change', () => this.change({ table: this.table.value as TableName }));
    this.strength.append(...STRENGTHS.map(name => new Option(games.menu.strengths[name], name)));
    this.strength.addEventListener('change', () => this.setStrength(this.strength.value as Strength));
    this.rows.addEventListener('input', () => (this.rowsValue.value = this.rows.value));
    const start = create('button', { id: 'match-start', class: 'main', type: 'submit' }, games.menu.start);
    this.node.append(this.players, this.strengthLabel, this.rules, this.rowsLabel, start);
    this.node.addEventListener('submit', event => {
      event.preventDefault();
      begin(this.match, Number(this.rows.value));
    });
  }

  /** Shows a match, and the number of rows of its tower. */
  show(match: Match, rows: number): void {
    this.match = { ...match, wins: match.players.map(() => 0), first: 0 };
    this.rows.value = this.rowsValue.value = String(rows);
    this.players.hidden = !WITH_PLAYERS.includes(match.mode);
    this.rules.hidden = !WITH_RULES.includes(match.mode);
    this.rowsLabel.hidden = WITH_TOWER.includes(match.mode);
    const computer = match.players.find(({ strength }) => strength !== null);
    this.strengthLabel.hidden = !computer;
    if (computer) this.strength.value = computer.strength!;
    this.showRules();
    this.showPlayers();
  }

  private setStrength(strength: Strength): void {
    const players = this.match.players.map(player => (player.strength === null ? player : { ...player, strength }));
    this.change({ players });
  }

  private change(change: Partial<Match>): void {
    this.match = { ...this.match, ...change };
    this.showRules();
  }

  private showRules(): void {
    this.table.value = this.match.table;
    this.note.textContent = games.tables[this.match.table].about;
  }

  private showPlayers(): void {
    const { players } = this.match;
    const button = (id: string, label: string, change: () => void, disabled: boolean) => {
      const node = create('button', {
        id,
        class: 'plain',
        type: 'button',
        'aria-label': label,
        title: label,
        disabled,
      });
      node.textContent = id === 'match-add' ? '+' : '−';
      node.addEventListener('click', () => {
        change();
        this.match = { ...this.match, wins: this.match.players.map(() => 0) };
        this.showPlayers();
      });
      return node;
    };
    const add = () => (this.match = { ...this.match, players: [...players, person('')] });
    const remove = () => (this.match = { ...this.match, players: players.slice(0, -1) });
    this.players.replaceChildren(
      create('legend', {}, games.menu.players),
      ...players.map((_, player) => this.nameField(player)),
      create(
        'div',
        { class: 'count' },
        button('match-remove', games.menu.remove, remove, players.length <= 1),
        button('match-add', games.menu.add, add, players.length >= MAX_PLAYERS),
      ),
    );
  }

  private nameField(player: number): HTMLElement {
    const input = create('input', {
      type: 'text',
      maxlength: 24,
      autocomplete: 'off',
      value: this.match.players[player].name,
      placeholder: games.player(player + 1),
      'aria-label': games.menu.name(player + 1),
    });
    input.addEventListener('input', () => {
      const players = this.match.players.map((other, k) => (k === player ? { ...other, name: input.value } : other));
      this.match = { ...this.match, players };
    });
    return create('div', { class: 'player' }, createToken({ ...this.match, players: [] }, player), input);
  }
}
