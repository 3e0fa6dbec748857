// What happened, in words that only screen readers hear.

import type { GameEvent } from '../engine/game-protocol';
import type { Frame } from '../engine/protocol';
import { text } from '../messages';
import { element } from './dom';

export class Announcer {
  private readonly element = element('announcer');
  private grip: string | null = null;

  /** Says a line. */
  say(line: string): void {
    // Emptied first, so that a repeated line is announced again.
    this.element.textContent = '';
    this.element.textContent = line;
  }

  /** Takes a frame: says what the hand and the tower did in it. */
  receive({ update }: Frame): void {
    const lines = update.events.map(lineOf).filter(line => line !== null);
    const grip = update.hand?.grip ?? null;
    if (grip === 'carry' && this.grip !== null && this.grip !== 'carry') lines.push(text.announce.out);
    this.grip = grip;
    if (lines.length > 0) this.say(lines.join(' '));
  }
}

function lineOf(event: GameEvent): string | null {
  switch (event.event) {
    case 'grasped':
      return text.announce.grasped(event.body);
    case 'released':
      return text.announce.released(event.body);
    case 'placed':
      return text.announce.placed(event.body);
    case 'fell':
      return text.announce.fell(event.bodies.length);
    default:
      return null;
  }
}
