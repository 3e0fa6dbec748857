// The free places on top: three across a full row, what is left of an unfinished one.

import { Vector3 } from 'three';
import { expect, test } from 'vitest';
import { topSlots } from '../../src/hand/control/slots';
import { PITCH, SIZE, tower } from './towers';

const alongOf = (turn: { x: number; y: number; z: number; w: number }) => 2 * Math.atan2(turn.z, turn.w);

test('a full row takes a new one across it', () => {
  for (const yaw of [0, 0.3, -1.2]) {
    const slots = topSlots(tower(['xxx', 'xxx', 'xxx'], yaw), null, SIZE);
    expect(slots).toHaveLength(3);
    for (const slot of slots) expect(slot.position.z).toBeCloseTo(3.5 * SIZE.z, 6);
    const distances = slots.map(s => Math.hypot(s.position.x, s.position.y)).sort((a, b) => a - b);
    [0, PITCH, PITCH].forEach((d, i) => expect(distances[i]).toBeCloseTo(d, 6));
    // The top row lies along x of the tower, so the new one lies along y.
    const turn = alongOf(slots[0].orientation) - yaw;
    expect(Math.abs(Math.sin(turn))).toBeCloseTo(1, 6);
  }
});

test('an unfinished row is finished first, wherever its blocks are', () => {
  for (const [row, free] of [
    ['x..', [0, 1]],
    ['.x.', [-1, 1]],
    ['..x', [-1, 0]],
    ['x.x', [0]],
    ['xx.', [1]],
  ] as const) {
    const slots = topSlots(tower(['xxx', 'xxx', row]), null, SIZE);
    const columns = slots.map(s => Math.round(s.position.y / PITCH) + 0).sort((a, b) => a - b);
    expect(columns, row).toEqual([...free]);
    for (const slot of slots) {
      expect(slot.position.z).toBeCloseTo(2.5 * SIZE.z, 6);
      expect(Math.abs(slot.position.x)).toBeLessThan(1e-6);
    }
  }
});

test('a slot keeps clear of a neighbour that lies askew of the plan, and none is offered where no block fits', () => {
  const shifted = (body: number, by: number, row: string) => {
    const bodies = tower(['xxx', 'xxx', row]);
    bodies.newest[7 * body + 1] += by;
    return topSlots(bodies, null, SIZE).map(s => s.position.y);
  };
  // Bodies 6 and 7 are those of the third row.
  expect(shifted(6, 0.002, 'x.x')).toHaveLength(0);
  const [middle] = shifted(6, -0.002, 'x.x');
  expect(middle).toBeLessThanOrEqual(0);
  expect(middle - (-PITCH - 0.002)).toBeGreaterThan(SIZE.y);
  expect(PITCH - middle).toBeGreaterThan(SIZE.y);
});

test('the held block does not count: taking the last of a row leaves its row to be built', () => {
  const bodies = tower(['xxx', 'xxx', '.x.']);
  const slots = topSlots(bodies, 6, SIZE);
  expect(slots).toHaveLength(3);
  for (const slot of slots) expect(slot.position.z).toBeCloseTo(2.5 * SIZE.z, 6);
});

test('a hole lower down is no slot, and a block on the table is no row', () => {
  const bodies = tower(['xxx', 'x.x', 'xxx']);
  expect(topSlots(bodies, null, SIZE).every(s => s.position.z > 3 * SIZE.z)).toBe(true);
  expect(topSlots(tower(['...']), null, SIZE)).toEqual([]);
  // With nothing but two blocks on the table the third place is beside them.
  const one = topSlots(tower(['xx.']), null, new Vector3().copy(SIZE));
  expect(one.every(s => s.position.z > 0 && s.position.z < SIZE.z)).toBe(true);
});
