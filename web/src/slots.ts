// Where a block may be put: the free places of the top row, or a new row across it when it is full.

import { Quaternion, Vector3 } from 'three';
import type { Bodies } from './bodies';

export interface Slot {
  /** Centre of a block that lies there, m. */
  position: Vector3;
  orientation: Quaternion;
  /** Height above it at which a block passes over what may lie beside it, m. */
  clearance: number;
}

/** Space between the blocks of a row, m. */
const GAP = 0.0003;
/** Space that the hand leaves to a neighbour that lies there already, m: it needs some play to come down beside it. */
const PLAY = 0.0006;
/** Least play on both sides together with which a place between two neighbours can be filled, m. */
const LEAST_PLAY = 0.00015;
/** Space left above what lies beside a slot, m. */
const PASS = 0.006;
const UP = new Vector3(0, 0, 1);

interface Lying {
  body: number;
  position: Vector3;
  /** Long axis, horizontal unit vector; its sign means nothing. */
  along: Vector3;
  top: number;
  bottom: number;
}

/** Blocks that lie flat, without `held`. */
function lying(bodies: Bodies, held: number | null): Lying[] {
  const all: Lying[] = [];
  for (let body = 0; body < bodies.count; body++) {
    if (body === held) continue;
    const turn = bodies.turn(body, bodies.newest);
    if (Math.abs(UP.clone().applyQuaternion(turn).z) < 0.98) continue;
    const position = bodies.position(body, bodies.newest);
    const half = bodies.edges(body, bodies.newest).z / 2;
    all.push({
      body,
      position,
      along: new Vector3(1, 0, 0).applyQuaternion(turn).setZ(0).normalize(),
      top: position.z + half,
      bottom: position.z - half,
    });
  }
  return all;
}

function mean(values: number[]): number {
  return values.reduce((a, b) => a + b, 0) / values.length;
}

/** Mean direction of axes whose sign means nothing. */
function meanAxis(row: Lying[]): Vector3 {
  const sum = new Vector3();
  for (const { along } of row) sum.addScaledVector(along, along.dot(row[0].along) < 0 ? -1 : 1);
  return sum.normalize();
}

/** The places on top for a block of edge lengths `size`; none while nothing stands. */
export function topSlots(bodies: Bodies, held: number | null, size: Vector3): Slot[] {
  const blocks = lying(bodies, held);
  if (blocks.length === 0) return [];
  const highest = Math.max(...blocks.map(b => b.position.z));
  const row = blocks.filter(b => highest - b.position.z < 0.5 * size.z);
  const rowAxis = meanAxis(row);
  const acrossRow = UP.clone().cross(rowAxis);
  const pitch = size.y + GAP;
  if (row.length >= 3) {
    const centre = new Vector3(mean(row.map(b => b.position.x)), mean(row.map(b => b.position.y)), 0);
    return places(centre, acrossRow, rowAxis, Math.max(...row.map(b => b.top)), size.z, pitch);
  }
  const bottom = mean(row.map(b => b.bottom));
  const beneath = blocks.filter(
    b => Math.abs(b.top - bottom) < 0.25 * size.z && Math.abs(b.along.dot(acrossRow)) > 0.9 && near(b, row, size.x),
  );
  // A row on the table has no row beneath it to say where its middle is.
  const supports = beneath.length > 0 ? beneath : row;
  const coordinate = (b: Lying) => b.position.dot(acrossRow);
  const centre = rowAxis
    .clone()
    .multiplyScalar(mean(row.map(b => b.position.dot(rowAxis))))
    .addScaledVector(acrossRow, mean(supports.map(coordinate)));
  const top = beneath.length > 0 ? Math.max(...beneath.map(b => b.top)) : bottom;
  const free: Slot[] = [];
  for (const slot of places(centre, rowAxis, acrossRow, top, size.z, pitch)) {
    const at = slot.position.dot(acrossRow);
    if (row.some(b => Math.abs(coordinate(b) - at) < 0.6 * pitch)) continue;
    // Neighbours may not lie where the plan has them.
    const below = row.map(coordinate).filter(c => c < at && at - c < 1.5 * pitch);
    const above = row.map(coordinate).filter(c => c > at && c - at < 1.5 * pitch);
    const least = below.length > 0 ? Math.max(...below) + size.y + PLAY : -Infinity;
    const most = above.length > 0 ? Math.min(...above) - size.y - PLAY : Infinity;
    if (most - least + 2 * PLAY < LEAST_PLAY) continue;
    const best = least > most ? (least + most) / 2 : Math.min(Math.max(at, least), most);
    slot.position.addScaledVector(acrossRow, best - at);
    free.push(slot);
  }
  return free;
}

function near(block: Lying, row: Lying[], reach: number): boolean {
  return row.some(b => Math.hypot(b.position.x - block.position.x, b.position.y - block.position.y) < reach);
}

/** Three places side by side in the direction `side`, for blocks whose long axis is `along`. */
function places(centre: Vector3, along: Vector3, side: Vector3, top: number, height: number, pitch: number): Slot[] {
  const orientation = new Quaternion().setFromAxisAngle(UP, Math.atan2(along.y, along.x));
  return [-1, 0, 1].map(column => ({
    position: centre
      .clone()
      .addScaledVector(side, column * pitch)
      .setZ(top + height / 2),
    orientation,
    clearance: height + PASS,
  }));
}
