// How far soft blocks let a tower sink: what is no fall.

import { Vector3 } from 'three';
import type { Bodies } from './bodies';

const UP = new Vector3(0, 0, 1);
/** Part of a block's height within which blocks lie in one row. */
const ROW = 0.5;

/**
 * By how much each block is lower than it would be were no block strained, m: what the rows beneath have lost in height, and half of what it has
 * lost itself. `heights`: of the centres when no block was strained, m. Null where none is.
 */
export function squash(bodies: Bodies, heights: ArrayLike<number>): Float64Array | null {
  if (!bodies.strained) return null;
  const loss = (body: number) =>
    2 * (bodies.halfExtentUnstrained(body, UP) - bodies.halfExtent(body, UP, bodies.newest));
  const order = Array.from({ length: bodies.count }, (_, body) => body).sort((a, b) => heights[a] - heights[b]);
  const sunk = new Float64Array(bodies.count);
  let beneath = 0;
  for (let first = 0; first < order.length;) {
    const limit = heights[order[first]] + ROW * bodies.size(order[first]).z;
    let end = first;
    let sum = 0;
    for (; end < order.length && heights[order[end]] <= limit; end++) {
      const own = loss(order[end]);
      sunk[order[end]] = beneath + own / 2;
      sum += own;
    }
    beneath += sum / (end - first);
    first = end;
  }
  return sunk;
}
