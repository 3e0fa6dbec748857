// Short lines for the player, which screen readers announce.

import { element } from './dom';

export class Notice {
  private readonly element = element('notice');
  private timer = 0;

  show(text: string, seconds = 3.5): void {
    clearTimeout(this.timer);
    // Emptied first, so that a repeated line is announced again.
    if (this.element.textContent === text) this.element.textContent = '';
    this.element.textContent = text;
    this.element.classList.add('shown');
    this.timer = window.setTimeout(() => this.element.classList.remove('shown'), seconds * 1000);
  }
}

/** Covers the page with the reason why it cannot run. */
export function showTrouble(text: string): void {
  element('trouble-text').textContent = text;
  element('trouble').hidden = false;
}
