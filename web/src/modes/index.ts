// The modes of play, the default first.

import { challenge } from './challenge';
import { daily } from './daily';
import { free } from './free';
import { hotSeat } from './hot-seat';
import type { Mode } from './mode';
import { opponent } from './opponent';
import { practice } from './practice';
import { replay } from './replay';
import { solo } from './solo';

export const MODES: readonly Mode[] = [free, hotSeat, opponent, solo, daily, practice, challenge, replay];

/** Returns the mode of that name, or the default one. */
export function modeOf(id: string | null): Mode {
  return MODES.find(mode => mode.id === id) ?? MODES[0];
}
