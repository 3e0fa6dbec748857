// Carrying: round the front of the tower, then up, over, and down into the slot.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { waypoint } from '../../src/hand/control/placement-path';
import { columnBelow, keepClear } from '../../src/hand/control/tower-clearance';
import { topSlots } from '../../src/hand/control/slots';
import { SIZE, tower } from './towers';

const slots = topSlots(tower(['xxx', 'xxx', 'xxx']), null, SIZE);
const level = slots[0].orientation;

test('the path to a slot rises, crosses, and lowers', () => {
  const slot = slots[1];
  const beside = new Vector3(0.12, 0.02, 0.03);
  const rise = waypoint(beside, level, slot, false);
  expect(rise.stage).toBe('rise');
  expect([rise.centre.x, rise.centre.y]).toEqual([beside.x, beside.y]);
  expect(rise.centre.z).toBeCloseTo(slot.position.z + slot.clearance, 9);
  expect(slot.clearance, 'over a neighbour of the same height').toBeGreaterThan(SIZE.z);
  const cross = waypoint(rise.centre, level, slot, false);
  expect(cross.stage).toBe('cross');
  const over = waypoint(cross.centre, cross.orientation, slot, false);
  expect(over.stage).toBe('lower');
  expect(over.centre.z, 'waits above its slot').toBeGreaterThan(slot.position.z);
  const down = waypoint(cross.centre, cross.orientation, slot, true);
  expect(down.centre.z, 'goes on until it touches').toBeLessThan(slot.position.z);
});

test('a block rotated against its slot is turned before it is lowered', () => {
  const rotated = level.clone().multiply(new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), 0.3));
  const next = waypoint(
    slots[0].position.clone().setZ(slots[0].position.z + slots[0].clearance),
    rotated,
    slots[0],
    true,
  );
  expect(next.stage).toBe('cross');
  expect(next.orientation.angleTo(level)).toBeLessThan(1e-6);
});

test('below the top the hand stays in front of the tower, above it is free', () => {
  const column = columnBelow(slots, SIZE)!;
  const towardViewer = new Vector3(0.6, -0.8, 0);
  const front = new Vector3(0.09, -0.1, 0.03);
  for (const wanted of [new Vector3(0, 0, 0.03), new Vector3(0.03, 0.05, 0.02), new Vector3(-0.05, 0.01, 0.05)]) {
    const led = keepClear(wanted, front, towardViewer, column);
    const offset = led.clone().sub(column.axis).setZ(0);
    expect(offset.length()).toBeCloseTo(column.radius, 9);
    expect(offset.dot(towardViewer)).toBeGreaterThan(0);
    expect(led.clone().sub(wanted).cross(towardViewer).length(), 'along the line of sight').toBeLessThan(1e-9);
    const behind = keepClear(wanted, front.clone().negate(), towardViewer, column);
    expect(behind.clone().sub(column.axis).dot(towardViewer)).toBeLessThan(0);
  }
  const above = new Vector3(0, 0, column.height + 0.01);
  expect(keepClear(above, front, towardViewer, column)).toBe(above);
  const aside = new Vector3(0.3, 0, 0.03);
  expect(keepClear(aside, front, towardViewer, column)).toBe(aside);
});
