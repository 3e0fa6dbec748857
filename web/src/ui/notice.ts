// Short lines for the player, which screen readers announce.

import { create, element } from './dom';

/** Line with a button, which stays until it is pressed or closed. */
export interface Offer {
  text: string;
  label: string;
  /** Label of the button that closes it. */
  close: string;
  action(): void;
}

export class Notice {
  private readonly element = element('notice');
  private timer = 0;
  private offered: Offer | null = null;

  show(text: string, seconds = 3.5): void {
    this.hold(text);
    this.timer = window.setTimeout(() => this.hide(), seconds * 1000);
  }

  /** Shows a line with a button; it comes back after lines that are shown meanwhile. */
  offer(offer: Offer): void {
    this.offered = offer;
    this.showOffer(offer);
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

  private showOffer({ text, label, close, action }: Offer): void {
    this.hold(text);
    const button = (name: string, act: () => void) => {
      const node = create('button', { class: 'plain' }, name);
      node.addEventListener('click', () => {
        this.offered = null;
        this.hide();
        act();
      });
      return node;
    };
    const buttons = create('span', { class: 'buttons' });
    buttons.append(
      button(label, action),
      button(close, () => undefined),
    );
    this.element.append(buttons);
  }

  private hide(): void {
    this.element.querySelector('.buttons')?.remove();
    this.element.classList.remove('shown');
    if (this.offered) this.showOffer(this.offered);
  }
}

/** Covers the page with the reason why it cannot run. */
export function showTrouble(text: string): void {
  element('trouble-text').textContent = text;
  element('trouble').hidden = false;
}
