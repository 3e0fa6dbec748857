// Settlement of a tower of soft blocks, which is no fall.

import { Vector3 } from 'three';
import type { Bodies } from '../../view/bodies';

const UP = new Vector3(0, 0, 1);
/** Height difference within which blocks belong to one row, as a fraction of a block's height. */
const ROW = 0.5;

/**
 * Returns the descent of each block by deformation, m: the height lost by the rows beneath, and
 * half of what it has lost itself. `heights`: of the centres without deformation, m. Null where no
 * block is deformed.
 */
export function settlement(bodies: Bodies, heights: ArrayLike<number>): Float64Array | null {
  if (!bodies.strained) return null;
  const loss = (body: number) =>
    2 * (bodies.halfExtentUnstrained(body, UP) - bodies.halfExtent(body, UP, bodies.newest));
  const order = Array.from({ length: bodies.count }, (_, body) => body).sort((a, b) => heights[a] - heights[b]);
  const descent = new Float64Array(bodies.count);
  let beneath = 0;
  for (let first = 0; first < order.length;) {
    const limit = heights[order[first]] + ROW * bodies.size(order[first]).z;
    let end = first;
    let sum = 0;
    for (; end < order.length && heights[order[end]] <= limit; end++) {
      const own = loss(order[end]);
      descent[order[end]] = beneath + own / 2;
      sum += own;
    }
    beneath += sum / (end - first);
    first = end;
  }
  return descent;
}
