// The menu: choose a mode of play and its rules, and begin.

import type { PageStore } from '../app/state';
import { games } from '../messages';
import type { Match } from '../modes/match';
import { create, element, icon } from '../ui/dom';
import { MatchForm } from './match-form';

export interface MenuActions {
  begin(match: Match, rows: number): void;
  openFile(): void;
  save(): void;
  share(): void;
  resign(): void;
  /** Fills a room below the players and rules of a mode that is chosen. */
  more(mode: string, room: HTMLElement): void;
}

/** Modes that the menu offers, in their order. */
export interface MenuEntry {
  id: keyof typeof games.modes;
  symbol: string;
  match(): Match;
}

export class MenuDialog {
  private readonly dialog = create('dialog', { id: 'menu', 'aria-labelledby': 'menu-title' });
  private readonly form: MatchForm;
  private readonly cards: HTMLButtonElement[];
  private readonly resign: HTMLButtonElement;
  private readonly save: HTMLButtonElement;
  private readonly share: HTMLButtonElement;
  /** Room above the modes, as for an unfinished game. */
  readonly top = create('div', { id: 'menu-top' });
  private readonly more = create('div', { id: 'menu-more' });

  constructor(
    private readonly store: PageStore,
    private readonly entries: readonly MenuEntry[],
    private readonly actions: MenuActions,
  ) {
    const open = create('button', { id: 'menu-open', class: 'pill', title: games.menu.openTitle });
    open.append(icon('i-games'), create('span', {}, games.menu.open));
    open.addEventListener('click', () => store.set({ menuOpen: true }));
    element('legend').after(open);
    document.body.append(this.dialog);
    this.form = new MatchForm((match, rows) => {
      this.dialog.close();
      actions.begin(match, rows);
    });
    this.cards = entries.map(entry => this.card(entry));
    const { records } = games;
    this.resign = this.button('menu-resign', games.menu.resign, () => actions.resign());
    this.save = this.button('menu-save', records.save, () => actions.save());
    this.share = this.button('menu-share', records.share, () => actions.share());
    const openFile = this.button('menu-file', records.open, () => actions.openFile());
    this.dialog.append(
      this.head(),
      this.top,
      create('div', { id: 'modes', role: 'group', 'aria-label': games.menu.title }, ...this.cards),
      this.form.node,
      this.more,
      create('div', { class: 'buttons small' }, openFile, this.save, this.share, this.resign),
    );
    this.dialog.addEventListener('close', () => store.set({ menuOpen: false }));
    store.subscribe(['frame', 'match'], () => this.dialog.open && this.showActions());
    store.subscribe(['menuOpen'], ({ menuOpen }) => {
      if (menuOpen && !this.dialog.open) this.show();
    });
  }

  get open(): boolean {
    return this.dialog.open;
  }

  close(): void {
    this.dialog.close();
  }

  /** Opens the menu at a mode. */
  offer(mode: string): void {
    this.store.set({ menuOpen: true });
    this.cards.find(card => card.dataset.mode === mode)?.click();
  }

  private show(): void {
    const { match, settings } = this.store.state;
    this.showActions();
    this.choose(this.entries.some(({ id }) => id === match.mode) ? match.mode : this.entries[0].id);
    this.form.show(match, settings.rows);
    this.dialog.showModal();
  }

  /** Shows what can be done with the game now, which goes on behind the menu. */
  private showActions(): void {
    const { match, frame } = this.store.state;
    const turn = frame?.update.turn;
    this.resign.hidden = !turn || turn.phase === 'over' || match.mode === 'replay';
    this.save.hidden = this.share.hidden = match.mode === 'replay';
  }

  private button(id: string, label: string, action: () => void): HTMLButtonElement {
    const node = create('button', { id, class: 'plain' }, label);
    node.addEventListener('click', () => {
      this.dialog.close();
      action();
    });
    return node;
  }

  private head(): HTMLElement {
    const close = create('button', { id: 'menu-close', class: 'plain', 'aria-label': games.menu.close });
    close.append(icon('i-close'));
    close.addEventListener('click', () => this.dialog.close());
    return create('header', {}, create('h2', { id: 'menu-title' }, games.menu.title), close);
  }

  private card({ id, symbol, match }: MenuEntry): HTMLButtonElement {
    const { name, about } = games.modes[id];
    const words = create('span', {}, create('b', {}, name), create('small', {}, about));
    const card = create('button', { class: 'mode', 'data-mode': id, 'aria-pressed': 'false' }, icon(symbol), words);
    card.addEventListener('click', () => {
      this.choose(id);
      // The players and rules of the match that is played are kept.
      const current = this.store.state.match;
      this.form.show(current.mode === id ? current : match(), this.store.state.settings.rows);
    });
    return card;
  }

  private choose(id: string): void {
    for (const card of this.cards) card.setAttribute('aria-pressed', String(card.dataset.mode === id));
    this.more.replaceChildren();
    this.actions.more(id, this.more);
  }
}
