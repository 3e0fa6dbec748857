// Free slots of the top row, or a new row across it when it is full.

import { Quaternion, Vector3 } from 'three';
import type { Quat, Slot, SlotId, Vec } from '../../engine/game-protocol';
import type { Bodies } from '../../view/bodies';

export interface FreeSlot extends SlotId {
  /** Centre of a block that lies there, m. */
  position: Vector3;
  orientation: Quaternion;
  /** Height above the slot at which a block passes over its neighbours, m. */
  clearance: number;
}

/** Gap between the blocks of a row, m. */
const GAP = 0.0003;
/**
 * Clearance to a neighbour that already lies there, m: the hand needs some play to come down beside
 * it.
 */
const PLAY = 0.0006;
/**
 * Smallest play on both sides together with which a slot between two neighbours can be filled, m.
 */
const MIN_PLAY = 0.00015;
/** Clearance above the neighbours of a slot, m. */
const PASS = 0.006;
const UP = new Vector3(0, 0, 1);

interface FlatBlock {
  position: Vector3;
  /** Long axis, horizontal unit vector of arbitrary sign. */
  along: Vector3;
  top: number;
  bottom: number;
}

/** Row of three slots to lay out. Lengths in m. */
interface Row {
  centre: Vector3;
  /** Long axis of its blocks, and the direction in which they lie side by side. */
  along: Vector3;
  side: Vector3;
  /** Height of the surface beneath. */
  bottom: number;
  /** Height of a block and distance between the centres of two neighbours. */
  height: number;
  pitch: number;
}

/**
 * Returns the slots on top for a block of edge lengths `size`, m, without counting the `held`
 * block; none while nothing stands.
 */
export function topSlots(bodies: Bodies, held: number | null, size: Vector3): FreeSlot[] {
  const blocks = flatBlocks(bodies, held);
  if (blocks.length === 0) return [];
  const highest = Math.max(...blocks.map(b => b.position.z));
  const row = blocks.filter(b => highest - b.position.z < 0.5 * size.z);
  const rowAxis = meanAxis(row);
  const side = UP.clone().cross(rowAxis);
  const common = { height: size.z, pitch: size.y + GAP };
  if (row.length >= 3) {
    const centre = new Vector3(mean(row.map(b => b.position.x)), mean(row.map(b => b.position.y)), 0);
    return layOut({ centre, along: side, side: rowAxis, bottom: Math.max(...row.map(b => b.top)), ...common });
  }
  const bottom = mean(row.map(b => b.bottom));
  const beneath = blocks.filter(
    b => Math.abs(b.top - bottom) < 0.25 * size.z && Math.abs(b.along.dot(side)) > 0.9 && isNear(b, row, size.x),
  );
  // A row on the table has no row beneath it that marks its middle.
  const supports = beneath.length > 0 ? beneath : row;
  const centre = rowAxis
    .clone()
    .multiplyScalar(mean(row.map(b => b.position.dot(rowAxis))))
    .addScaledVector(side, mean(supports.map(b => b.position.dot(side))));
  const surface = beneath.length > 0 ? Math.max(...beneath.map(b => b.top)) : bottom;
  const slots = layOut({ centre, along: rowAxis, side, bottom: surface, ...common });
  const taken = row.map(b => b.position.dot(side));
  return slots.filter(slot => fitBetween(slot, taken, side, size.y));
}

/**
 * Moves a slot of an unfinished row clear of its neighbours; returns false if it is taken or no
 * block fits.
 */
function fitBetween(slot: FreeSlot, taken: number[], side: Vector3, width: number): boolean {
  const pitch = width + GAP;
  const offset = slot.position.dot(side);
  if (taken.some(c => Math.abs(c - offset) < 0.6 * pitch)) return false;
  const below = taken.filter(c => c < offset && offset - c < 1.5 * pitch);
  const above = taken.filter(c => c > offset && c - offset < 1.5 * pitch);
  const min = below.length > 0 ? Math.max(...below) + width + PLAY : -Infinity;
  const max = above.length > 0 ? Math.min(...above) - width - PLAY : Infinity;
  if (max - min + 2 * PLAY < MIN_PLAY) return false;
  const best = min > max ? (min + max) / 2 : Math.min(Math.max(offset, min), max);
  slot.position.addScaledVector(side, best - offset);
  return true;
}

/** Blocks that lie flat, without the `held` one. */
function flatBlocks(bodies: Bodies, held: number | null): FlatBlock[] {
  const all: FlatBlock[] = [];
  for (let body = 0; body < bodies.count; body++) {
    if (body === held) continue;
    const rotation = bodies.rotation(body, bodies.newest);
    if (Math.abs(UP.clone().applyQuaternion(rotation).z) < 0.98) continue;
    const position = bodies.position(body, bodies.newest);
    const half = bodies.edges(body, bodies.newest).z / 2;
    const along = new Vector3(1, 0, 0).applyQuaternion(rotation).setZ(0).normalize();
    all.push({ position, along, top: position.z + half, bottom: position.z - half });
  }
  return all;
}

function mean(values: number[]): number {
  return values.reduce((a, b) => a + b, 0) / values.length;
}

/** Mean direction of axes of arbitrary sign. */
function meanAxis(row: FlatBlock[]): Vector3 {
  const sum = new Vector3();
  for (const { along } of row) sum.addScaledVector(along, along.dot(row[0].along) < 0 ? -1 : 1);
  return sum.normalize();
}

function isNear(block: FlatBlock, row: FlatBlock[], reach: number): boolean {
  return row.some(b => Math.hypot(b.position.x - block.position.x, b.position.y - block.position.y) < reach);
}

/** Three slots side by side. */
function layOut({ centre, along, side, bottom, height, pitch }: Row): FreeSlot[] {
  const orientation = new Quaternion().setFromAxisAngle(UP, Math.atan2(along.y, along.x));
  return [0, 1, 2].map(cell => ({
    row: Math.round(bottom / height),
    cell,
    position: centre
      .clone()
      .addScaledVector(side, (cell - 1) * pitch)
      .setZ(bottom + height / 2),
    orientation,
    clearance: height + PASS,
  }));
}

export function slotUpdate({ row, cell, position, orientation, clearance }: FreeSlot): Slot {
  return {
    row,
    cell,
    position: position.toArray() as Vec,
    orientation: orientation.toArray() as Quat,
    clearance,
  };
}
