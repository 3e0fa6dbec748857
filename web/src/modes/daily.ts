// Tower of the day: the same tower for everyone, to the bit, and your best game on it as a ghost.

import type { Settings } from '../app/state';
import { matchOf, person } from './match';
import type { Mode } from './mode';
import { pointsMode } from './turns';

export const daily: Mode = {
  ...pointsMode,
  id: 'daily',
  match: () => matchOf('daily', 'solo', [person('')]),
};

/** Day of a time in UTC, such as 2026-03-09. */
export function dayOf(time: Date): string {
  return time.toISOString().slice(0, 10);
}

/** Settings of the tower of a day: all that its bits follow from. */
export function dailySettings(day: string): Partial<Settings> {
  const seed = Number(day.replaceAll('-', ''));
  const blocks = { block: 'dissertation', form: 'rigid', stiffness: 1e6, springs: null } as const;
  return { scene: null, rows: 18, seed, sleep: true, ...blocks };
}
