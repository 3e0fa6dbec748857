// The hand without a pointer: the next block in a direction, and a gamepad as plain data.

import { expect, test } from 'vitest';
import { nearest, neighbour } from '../../src/hand/neighbour';
import { pulse } from '../../src/hand/haptics';
import { BUTTON, readPad, type Pad } from '../../src/hand/pad';

/** A grid of three columns and four rows on the screen; y is down. */
const GRID = Array.from({ length: 12 }, (_, i) => ({ x: 100 + 40 * (i % 3), y: 100 + 20 * Math.floor(i / 3) }));
const [LEFT, RIGHT, UP, DOWN] = [
  [-1, 0],
  [1, 0],
  [0, -1],
  [0, 1],
].map(([x, y]) => ({ x, y }));

test('arrows lead from block to block of a grid, and stop at its edges', () => {
  const from = (i: number, direction: { x: number; y: number }) => neighbour(GRID, GRID[i], direction);
  expect([from(4, LEFT), from(4, RIGHT), from(4, UP), from(4, DOWN)]).toEqual([3, 5, 1, 7]);
  expect([from(0, LEFT), from(0, UP), from(11, RIGHT), from(11, DOWN)]).toEqual([null, null, null, null]);
});

test('every block that is seen can be reached from every other', () => {
  // A tower seen at a corner: rows of three ends on alternating sides.
  const seen = Array.from({ length: 30 }, (_, i) => {
    const [row, cell] = [Math.floor(i / 3), i % 3];
    return { x: 200 + (row % 2 ? 18 : -58) + 20 * cell, y: 400 - 22 * row };
  });
  const reached = new Set([0]);
  for (const at of reached)
    for (const direction of [LEFT, RIGHT, UP, DOWN]) {
      const next = neighbour(seen, seen[at], direction);
      if (next !== null) reached.add(next);
    }
  expect(reached.size).toBe(seen.length);
});

test('hidden blocks are passed over, and the first one is the nearest to the middle', () => {
  const seen = GRID.map((position, i) => (i === 4 ? null : position));
  expect(neighbour(seen, GRID[3], RIGHT)).toBe(5);
  expect(nearest(seen, { x: 141, y: 119 })).toBe(1);
  expect(nearest([null], { x: 0, y: 0 })).toBeNull();
});

function pad(change: { axes?: number[]; buttons?: Record<number, number> } = {}): Pad {
  const buttons = Array.from({ length: 17 }, (_, i) => {
    const value = change.buttons?.[i] ?? 0;
    return { pressed: value > 0.5, value };
  });
  return { axes: change.axes ?? [0, 0, 0, 0], buttons };
}

test('a trigger gives its force, and pulls towards the viewer', () => {
  for (const value of [0.1, 0.5, 1]) {
    const { force, steer } = readPad(pad({ buttons: { [BUTTON.pull]: value } }), pad());
    expect([force, steer.away]).toEqual([value, -value]);
  }
  expect(readPad(pad({ buttons: { [BUTTON.push]: 0.7 } }), pad()).steer.away).toBe(0.7);
  expect(readPad(pad(), pad()).force).toBeNull();
});

test('a button counts once while it is down, and a stick that drifts at rest moves nothing', () => {
  const down = pad({ buttons: { [BUTTON.take]: 1 } });
  expect(readPad(down, pad()).pressed).toEqual(['take']);
  expect(readPad(down, down).pressed).toEqual([]);
  const drift = readPad(pad({ axes: [0.1, -0.08, 0.05, 0.1] }), null);
  expect([drift.steer, drift.camera, drift.flick]).toEqual([{ right: 0, up: -0, away: 0 }, { x: 0, y: -0 }, null]);
});

test('a stick grows from its rest without a jump to its full displacement', () => {
  const right = (x: number) => readPad(pad({ axes: [x, 0, 0, 0] }), null).steer.right;
  expect(right(0.19)).toBeLessThan(0.02);
  expect(right(1)).toBeCloseTo(1, 12);
  const steps = Array.from({ length: 50 }, (_, i) => right(i / 49));
  expect(steps).toEqual([...steps].sort((a, b) => a - b));
  const out = pad({ axes: [0, 1, 0, 0] });
  expect(readPad(out, pad()).flick).toEqual({ x: 0, y: 1 });
  expect(readPad(out, out).flick).toBeNull();
});

test('a pulse grows with the force, and a light touch is not felt', () => {
  const pulses = Array.from({ length: 40 }, (_, i) => pulse(i / 30));
  expect(pulses).toEqual([...pulses].sort((a, b) => a - b));
  expect([pulse(0.1), pulse(1), pulse(2)]).toEqual([0, 1, 1]);
});
