// Keeps a carried block from being led through the tower: below the top its way goes round the front, as a hand's would.

import { Vector3 } from 'three';
import type { Slot } from './slots';

/** Space left beside the tower, m. */
const MARGIN = 0.006;

export interface Column {
  /** Axis of the tower; its height means nothing. */
  axis: Vector3;
  /** Distance from the axis at which the centre of a block is clear of the tower, m. */
  radius: number;
  /** Height above which the centre of a block is clear of the tower, m. */
  height: number;
}

/** The space that a block of edge lengths `size` must keep out of, told from the slots on top. */
export function columnUnder(slots: Slot[], size: Vector3): Column | null {
  if (slots.length === 0) return null;
  const axis = slots.reduce((sum, s) => sum.add(s.position), new Vector3()).divideScalar(slots.length);
  const row = size.x / 2;
  return { axis, radius: Math.hypot(row, row) + size.x / 2 + MARGIN, height: axis.z + slots[0].clearance };
}

export function isClear(centre: Vector3, { axis, radius, height }: Column): boolean {
  return centre.z > height || Math.hypot(centre.x - axis.x, centre.y - axis.y) >= radius;
}

/**
 * The wanted centre moved out of the column along the line of sight, so that it stays where it was on the screen.
 * `towards`: horizontal unit vector to the viewer. A block behind the tower (`at`) stays behind it.
 */
export function keepClear(wanted: Vector3, at: Vector3, towards: Vector3, column: Column): Vector3 {
  if (isClear(wanted, column)) return wanted;
  const offset = wanted.clone().sub(column.axis).setZ(0);
  const behind = at.clone().sub(column.axis).dot(towards) < 0;
  const along = offset.dot(towards);
  const root = Math.sqrt(along * along - offset.lengthSq() + column.radius * column.radius);
  return wanted.clone().addScaledVector(towards, behind ? -along - root : -along + root);
}
