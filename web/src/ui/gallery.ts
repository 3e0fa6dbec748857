// The gallery of scenes: a dialog with a picture of each.

import type { Play } from '../app/play';
import { text } from '../messages';
import { element, onClick } from './dom';

type Exhibit = keyof typeof text.gallery.names;

export class Gallery {
  private readonly dialog = element<HTMLDialogElement>('gallery');

  constructor(private readonly play: Play) {
    onClick('gallery-open', () => this.show());
    onClick('gallery-close', () => this.dialog.close());
  }

  private show(): void {
    const list = element('gallery-list');
    // The pictures are loaded when somebody wants to see them.
    if (list.childElementCount === 0) {
      const names = Object.keys(text.gallery.names) as Exhibit[];
      list.append(...names.map(name => this.item(name)));
    }
    this.dialog.showModal();
  }

  private item(name: Exhibit): HTMLElement {
    const item = document.createElement('li');
    const card = document.createElement(name === 'museum' ? 'a' : 'button');
    const [picture, title, note] = ['img', 'b', 'span'].map(tag => document.createElement(tag));
    Object.assign(picture, { src: `gallery/${name}.webp`, width: 384, height: 256, alt: '' });
    title.textContent = text.gallery.names[name];
    note.textContent = noteOf(name);
    card.append(picture, title, note);
    if (card instanceof HTMLAnchorElement) card.href = 'museum.html';
    else card.addEventListener('click', () => this.choose(name));
    item.append(card);
    return item;
  }

  private choose(name: Exhibit): void {
    this.dialog.close();
    this.play.rebuild({ scene: name === 'tower' ? null : name });
  }
}

function noteOf(name: Exhibit): string {
  if (name === 'tower') return text.gallery.tower;
  return name === 'museum' ? text.gallery.museum : text.scenes[name];
}
