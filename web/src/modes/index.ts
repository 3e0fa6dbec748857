// The modes of play, the default first.

import { free } from './free';
import { hotSeat } from './hot-seat';
import type { Mode } from './mode';
import { practice } from './practice';
import { solo } from './solo';

export const MODES: readonly Mode[] = [free, hotSeat, solo, practice];

/** Returns the mode of that name, or the default one. */
export function modeOf(id: string | null): Mode {
  return MODES.find(mode => mode.id === id) ?? MODES[0];
}
