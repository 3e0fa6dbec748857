// The modes of play, the default first.

import { free } from './free';
import type { Mode } from './mode';

export const MODES: readonly Mode[] = [free];

/** Returns the mode of that name, or the default one. */
export function modeOf(id: string | null): Mode {
  return MODES.find(mode => mode.id === id) ?? MODES[0];
}
