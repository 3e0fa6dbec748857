// Tower of the day: the same tower for everyone, to the bit, and your best game on it as a ghost.

import { setupOf, type Settings } from '../app/state';
import type { Setup } from '../engine/protocol';
import { matchOf, person, rulesOf, type Match } from './match';
import type { Mode } from './mode';
import { pointsMode } from './turns';

const match = (): Match => matchOf('daily', 'solo', [person('')]);

export const daily: Mode = { ...pointsMode, id: 'daily', match };

/** Day of a time in UTC, such as 2026-03-09. */
export function dayOf(time: Date): string {
  return time.toISOString().slice(0, 10);
}

/** Settings of the tower of a day: all that its bits follow from. */
export function dailySettings(day: string): Settings {
  const seed = Number(day.replaceAll('-', ''));
  const blocks = { block: 'dissertation', form: 'rigid', stiffness: 1e6, springs: null } as const;
  return { scene: null, rows: 18, seed, sleep: true, ...blocks };
}

/** Setup of a game on the tower of a day. */
export function dailySetup(day: string): Setup {
  const settings = dailySettings(day);
  return setupOf(settings, rulesOf(match(), settings.seed));
}
