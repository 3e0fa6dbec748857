// Commands that wait for the next step. A step takes one of them, so those that follow each other
// and add up are merged.

import type { GameCommand, Vec } from './game-protocol';

export const IDLE: GameCommand = { command: 'idle' };

export class CommandQueue {
  private waiting: { number: number; command: GameCommand }[] = [];
  /** Number of the last command that was taken. */
  applied = 0;

  /** Adds a command; numbers grow from one to the next. */
  add(number: number, command: GameCommand): void {
    const last = this.waiting[this.waiting.length - 1];
    const merged = last && merge(last.command, command);
    if (merged) this.waiting[this.waiting.length - 1] = { number, command: merged };
    else this.waiting.push({ number, command });
  }

  get isEmpty(): boolean {
    return this.waiting.length === 0;
  }

  /** Removes and returns the command for the next step. */
  next(): GameCommand {
    const first = this.waiting.shift();
    if (!first) return IDLE;
    this.applied = first.number;
    return first.command;
  }

  clear(): void {
    this.waiting = [];
  }
}

function merge(first: GameCommand, then: GameCommand): GameCommand | null {
  if (first.command === 'move' && then.command === 'move') {
    const displacement = first.displacement.map((x, k) => x + then.displacement[k]) as Vec;
    return { ...then, displacement };
  }
  if (first.command === 'set_hand' && then.command === 'set_hand') return { ...first, ...then };
  return null;
}
