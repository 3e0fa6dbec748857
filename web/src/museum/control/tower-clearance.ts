// Keeps a carried block clear of the tower: below the top it moves round the front, as a hand
// would.

import { Vector3 } from 'three';
import type { FreeSlot } from './slots';

/** Clearance beside the tower, m. */
const MARGIN = 0.006;

/** Cylinder around the tower that the centre of a block keeps out of. */
export interface Column {
  /** A point on the axis; its height is not used. */
  axis: Vector3;
  /** m. */
  radius: number;
  /** m. */
  height: number;
}

/** Returns the column below the slots for a block of edge lengths `size`, m; null without slots. */
export function columnBelow(slots: FreeSlot[], size: Vector3): Column | null {
  if (slots.length === 0) return null;
  const axis = slots.reduce((sum, s) => sum.add(s.position), new Vector3()).divideScalar(slots.length);
  const row = size.x / 2;
  return { axis, radius: Math.hypot(row, row) + size.x / 2 + MARGIN, height: axis.z + slots[0].clearance };
}

export function isClear(centre: Vector3, { axis, radius, height }: Column): boolean {
  return centre.z > height || Math.hypot(centre.x - axis.x, centre.y - axis.y) >= radius;
}

/**
 * Moves a wanted centre out of the column along the line of sight, so that it keeps its position on
 * the screen. `towardViewer`: horizontal unit vector. A block whose centre (`current`) is behind
 * the tower stays behind it.
 */
export function keepClear(wanted: Vector3, current: Vector3, towardViewer: Vector3, column: Column): Vector3 {
  if (isClear(wanted, column)) return wanted;
  const offset = wanted.clone().sub(column.axis).setZ(0);
  const behind = current.clone().sub(column.axis).dot(towardViewer) < 0;
  const along = offset.dot(towardViewer);
  const root = Math.sqrt(along * along - offset.lengthSq() + column.radius * column.radius);
  return wanted.clone().addScaledVector(towardViewer, behind ? -along - root : -along + root);
}
