// The next of several positions on the screen in a direction.

import type { ScreenVector } from './screen-to-world';

/** Cost of a distance across the direction over one along it. */
const ACROSS = 2.5;

/**
 * Returns the index of the nearest position from another in a direction, where y is down; null
 * where there is none. A position within 45 degrees of the opposite is never chosen.
 */
export function neighbour(
  positions: readonly (ScreenVector | null)[],
  from: ScreenVector,
  direction: ScreenVector,
): number | null {
  const length = Math.hypot(direction.x, direction.y);
  let best: number | null = null;
  let min = Infinity;
  positions.forEach((position, i) => {
    if (!position || length === 0) return;
    const [x, y] = [position.x - from.x, position.y - from.y];
    const along = (x * direction.x + y * direction.y) / length;
    const across = Math.abs(x * direction.y - y * direction.x) / length;
    if (along <= 1 || across > 3 * along) return;
    const cost = along + ACROSS * across;
    if (cost < min) [best, min] = [i, cost];
  });
  return best;
}

/** Returns the index of the position nearest to another; null where there is none. */
export function nearest(positions: readonly (ScreenVector | null)[], to: ScreenVector): number | null {
  let best: number | null = null;
  let min = Infinity;
  positions.forEach((position, i) => {
    const distance = position ? Math.hypot(position.x - to.x, position.y - to.y) : Infinity;
    if (distance < min) [best, min] = [i, distance];
  });
  return best;
}
