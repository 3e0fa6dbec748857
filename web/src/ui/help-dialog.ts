// The help, which opens by itself on the first visit.

import { recall, remember } from '../app/memory';
import type { PageStore } from '../app/state';
import type { Options } from '../app/url';
import { element, onClick } from './dom';

export class HelpDialog {
  private readonly dialog = element<HTMLDialogElement>('help');

  constructor(store: PageStore, options: Options) {
    store.subscribe(['helpOpen'], ({ helpOpen }) => {
      if (helpOpen && !this.dialog.open) this.dialog.showModal();
    });
    this.dialog.addEventListener('close', () => {
      store.set({ helpOpen: false });
      remember('help', 'seen');
    });
    onClick('help-open', () => store.set({ helpOpen: true }));
    if (options.help && recall('help') === null) store.set({ helpOpen: true });
  }
}
