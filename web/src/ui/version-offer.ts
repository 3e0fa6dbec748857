// The offer of a new version of the page: announced when a tower begins, never in mid-game, and
// loaded when the player asks for it.

import type { PageStore } from '../app/state';
import { text } from '../messages';
import { keepOffline } from '../offline/versions';
import { element } from './dom';
import type { Notice } from './notice';

/** Duration of the notice, s. */
const LONG = 8;

/** Keeps the page offline, and offers new versions. */
export function offerVersions(store: PageStore, notice: Notice): void {
  let ready = false;
  keepOffline({
    ready(load) {
      ready = true;
      const button = element('new-version');
      button.hidden = false;
      button.addEventListener('click', load);
    },
  });
  store.subscribe(['world'], ({ world }) => {
    if (world && ready) notice.show(text.notices.newVersion, LONG);
  });
}
