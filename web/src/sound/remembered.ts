// Volume and mute as they were left.

import { recall } from '../app/memory';

/** Volume of the first visit, 0 to 1. */
const VOLUME = 0.7;

export function recallSound(): { volume: number; muted: boolean } {
  const volume = Number(recall('volume') ?? VOLUME);
  return { volume: volume >= 0 && volume <= 1 ? volume : VOLUME, muted: recall('muted') === 'true' };
}
