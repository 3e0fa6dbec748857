// The bar of the hand and of time, and the bar of a carried block.

import type { Play } from '../app/play';
import type { PageStore } from '../app/state';
import type { GripMode } from '../engine/game-protocol';
import { text } from '../messages';
import { element, onClick } from './dom';

export class Toolbar {
  private readonly grips = [...document.querySelectorAll<HTMLButtonElement>('[data-grip]')];

  constructor(
    private readonly store: PageStore,
    play: Play,
  ) {
    const { hand } = play;
    onClick('place', () => hand.place());
    onClick('turn-left', () => hand.turn(Math.PI / 2));
    onClick('turn-right', () => hand.turn(-Math.PI / 2));
    onClick('tip', () => hand.tip());
    onClick('let-go', () => hand.letGo());
    onClick('pause', () => play.togglePause());
    onClick('reset', () => play.build());
    this.grips.forEach((button, i) => this.bind(button, i));
    store.subscribe(['grip'], ({ grip }) => this.showGrip(grip));
    store.subscribe(['paused'], ({ paused }) => showPaused(paused));
  }

  /** Shows the bar of a carried block. */
  showCarrying(carrying: boolean): void {
    element('carrying').hidden = !carrying;
  }

  showPlaceable(placeable: boolean): void {
    element<HTMLButtonElement>('place').disabled = !placeable;
  }

  private bind(button: HTMLButtonElement, i: number): void {
    button.addEventListener('click', () => this.store.set({ grip: button.dataset.grip as GripMode }));
    button.addEventListener('keydown', event => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = this.grips[(i + step + this.grips.length) % this.grips.length];
      next.focus();
      next.click();
      event.preventDefault();
      event.stopPropagation();
    });
  }

  private showGrip(grip: GripMode): void {
    for (const button of this.grips) {
      const chosen = button.dataset.grip === grip;
      button.setAttribute('aria-checked', String(chosen));
      button.tabIndex = chosen ? 0 : -1;
    }
  }
}

function showPaused(paused: boolean): void {
  const button = element('pause');
  button.setAttribute('aria-pressed', String(paused));
  button.querySelector('use')!.setAttribute('href', paused ? '#i-play' : '#i-pause');
  button.querySelector('span')!.textContent = paused ? text.toolbar.resume : text.toolbar.pause;
}
