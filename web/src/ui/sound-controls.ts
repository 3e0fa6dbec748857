// The button that mutes the game, and the slider of its volume.

import type { PageStore } from '../app/state';
import { text } from '../messages';
import { element, onClick, setText } from './dom';

export class SoundControls {
  constructor(store: PageStore) {
    const button = element<HTMLButtonElement>('mute');
    const slider = element<HTMLInputElement>('volume');
    onClick('mute', () => store.set({ muted: !store.state.muted }));
    // A slider that is moved is meant to be heard.
    slider.addEventListener('input', () => store.set({ volume: Number(slider.value) / 100, muted: false }));
    store.subscribe(['volume', 'muted'], ({ volume, muted }) => {
      button.setAttribute('aria-pressed', String(muted));
      button.querySelector('use')!.setAttribute('href', muted ? '#i-muted' : '#i-sound');
      slider.value = String(Math.round(100 * volume));
      setText('volume-value', muted ? text.panel.muted : text.panel.percent(volume));
    });
  }
}
