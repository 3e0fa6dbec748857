// Asks for the name under which the game of somebody else is ranked on the tower of the day.

import { games } from '../messages';
import type { Verified } from '../study/jobs';
import { create } from '../ui/dom';

/** Choice of the player: a name to rank the game by, to watch it, or neither. */
export type RankChoice = { name: string } | 'watch' | null;

/** Longest name. */
const MAX_NAME = 24;

export class RankDialog {
  private readonly dialog = create('dialog', { id: 'rank', 'aria-labelledby': 'rank-title' });
  private readonly score = create('p', { class: 'note' });
  private readonly name = create('input', {
    id: 'rank-name',
    type: 'text',
    maxlength: MAX_NAME,
    autocomplete: 'off',
    required: true,
  });
  private choice: RankChoice = null;

  constructor() {
    const { daily } = games;
    const form = create('form', { method: 'dialog' });
    const watch = create('button', { id: 'rank-watch', class: 'plain', type: 'button' }, daily.watchIt);
    const rank = create('button', { id: 'rank-it', class: 'main', type: 'submit' }, daily.rank);
    form.append(create('label', {}, daily.whose, this.name), create('div', { class: 'buttons' }, rank, watch));
    watch.addEventListener('click', () => this.close('watch'));
    form.addEventListener('submit', event => {
      event.preventDefault();
      const name = this.name.value.trim();
      if (name) this.close({ name });
    });
    this.dialog.append(create('h2', { id: 'rank-title' }, daily.found), this.score, form);
    document.body.append(this.dialog);
  }

  /** Asks about a game; `file` is the name of its file. */
  ask({ turn, height }: Verified, file: string): Promise<RankChoice> {
    this.score.textContent = games.daily.score(turn?.scores[0] ?? 0, Math.round(height * 1000));
    this.name.value = nameIn(file);
    this.choice = null;
    this.dialog.showModal();
    this.name.select();
    return new Promise(resolve => {
      this.dialog.addEventListener('close', () => resolve(this.choice), { once: true });
    });
  }

  private close(choice: RankChoice): void {
    this.choice = choice;
    this.dialog.close();
  }
}

/** Name of a player in that of a file; empty where the page named the file. */
export function nameIn(file: string): string {
  const name = file.replace(/\.[^.]*$/, '').replace(/^teeter-\d{4}-\d\d-\d\d-\d+( ?\(\d+\))?[-_ ]*/, '');
  return name.trim().slice(0, MAX_NAME);
}
