// Challenge: the tower of a shared move, to be beaten.

import { games } from '../messages';
import { matchOf, person, type Match } from './match';
import type { Mode } from './mode';
import { turnEvent, turnStatus } from './turns';

/** Simulated time at which the block was grasped first, s. */
let grasped: number | null = null;
let now = 0;
let done = false;

export const challenge: Mode = {
  id: 'challenge',
  match: () => matchOf('challenge', 'official', [person('')]),
  rules() {
    grasped = null;
    done = false;
    return { canTurn: true };
  },
  overlay(update, blocks, match) {
    const { goal } = match;
    const status = turnStatus(update, blocks, match);
    return { status: goal === undefined ? status : games.challenge.goal(goal) };
  },
  commands({ report }) {
    now = report.time;
    return [];
  },
  onEvent(event, ui, match) {
    if (event.event === 'grasped') grasped ??= now;
    if (event.event === 'settled' && !done) {
      done = true;
      ui.notice(result(match, now - (grasped ?? now)), 8);
      return;
    }
    if (event.event !== 'turn_started') turnEvent(event, ui, match);
  },
};

/** Line about a move that took so many seconds. */
function result({ goal }: Match, seconds: number): string {
  const { beaten, slower, stands } = games.challenge;
  if (goal === undefined) return stands(seconds);
  return seconds < goal ? beaten(seconds, goal) : slower(seconds, goal);
}
