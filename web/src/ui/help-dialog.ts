// The help.

import type { PageStore } from '../app/state';
import { element, onClick } from './dom';

export class HelpDialog {
  private readonly dialog = element<HTMLDialogElement>('help');

  constructor(store: PageStore) {
    store.subscribe(['helpOpen'], ({ helpOpen }) => {
      if (helpOpen && !this.dialog.open) this.dialog.showModal();
    });
    this.dialog.addEventListener('close', () => {
      store.set({ helpOpen: false });
    });
    onClick('help-open', () => store.set({ helpOpen: true }));
  }
}
