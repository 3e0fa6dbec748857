// The help, which opens by itself on the first visit.

import type { PageStore } from '../app/state';
import type { Options } from '../app/url';
import { element, onClick } from './dom';

const SEEN = 'teeter.help';

export class HelpDialog {
  private readonly dialog = element<HTMLDialogElement>('help');

  constructor(store: PageStore, options: Options) {
    store.subscribe(['helpOpen'], ({ helpOpen }) => {
      if (helpOpen && !this.dialog.open) this.dialog.showModal();
    });
    this.dialog.addEventListener('close', () => {
      store.set({ helpOpen: false });
      remember();
    });
    onClick('help-open', () => store.set({ helpOpen: true }));
    if (options.help && !wasSeen()) store.set({ helpOpen: true });
  }

  get open(): boolean {
    return this.dialog.open;
  }
}

// Storage may be forbidden; the help then opens on every visit.
function wasSeen(): boolean {
  try {
    return localStorage.getItem(SEEN) !== null;
  } catch {
    return false;
  }
}

function remember(): void {
  try {
    localStorage.setItem(SEEN, 'seen');
  } catch {
    // Only the next visit depends on it.
  }
}
