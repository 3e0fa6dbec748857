// Short lines for the player, which screen readers announce.

import { element } from './dom';

export class Notice {
  private readonly element = element('notice');
  private timer = 0;

  show(text: string, seconds = 3.5): void {
    this.hold(text);
    this.timer = window.setTimeout(() => this.hide(), seconds * 1000);
  }

  /** Shows a line until it is released or another one is shown. */
  hold(text: string): void {
    clearTimeout(this.timer);
    // Emptied first, so that a repeated line is announced again.
    if (this.element.textContent === text) this.element.textContent = '';
    this.element.textContent = text;
    this.element.classList.add('shown');
  }

  /** Hides a line that is held. */
  release(text: string): void {
    if (this.element.textContent === text) this.hide();
  }

  private hide(): void {
    this.element.classList.remove('shown');
  }
}

/** Covers the page with the reason why it cannot run. */
export function showTrouble(text: string): void {
  element('trouble-text').textContent = text;
  element('trouble').hidden = false;
}
