// The hand's target: limited speed, limited lead, no lead gained while the force is spent.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { Leash } from '../../src/leash';
import type { Quat, Vec, Wish } from '../../src/protocol';
import { rotate, turnTowards } from '../../src/vectors';

const wish = (change: Partial<Wish>): Wish => ({
  body: 0,
  anchor: [0, 0, 0],
  target: [1, 0, 0],
  orientation: null,
  grip: 'slide',
  axis: [0, 0, 0],
  maxForce: 4,
  maxTorque: 0.02,
  speed: 0.25,
  lead: 0.012,
  seconds: null,
  ...change,
});
const DT = 1 / 60;

test('moves at its speed and no faster, and arrives exactly', () => {
  const leash = new Leash([0, 0, 0], [0, 0, 0, 1]);
  const order = wish({ target: [0.01, 0, 0], lead: 1 });
  leash.advance(order, [0, 0, 0], false, DT);
  expect(leash.target()[0]).toBeCloseTo(0.25 * DT, 12);
  for (let i = 0; i < 10; i++) leash.advance(order, [0, 0, 0], false, DT);
  expect(leash.target()).toEqual([0.01, 0, 0]);
});

test('stays within reach of a point that sticks', () => {
  const leash = new Leash([0, 0, 0], [0, 0, 0, 1]);
  for (let i = 0; i < 60; i++) leash.advance(wish({}), [0, 0, 0], false, DT);
  expect(leash.target()[0]).toBeCloseTo(0.012, 9);
});

test('gains no lead while the hand gives all it has, and follows when the point comes loose', () => {
  const leash = new Leash([0, 0, 0], [0, 0, 0, 1]);
  leash.advance(wish({}), [0, 0, 0], false, DT);
  const lead = leash.target()[0];
  for (let i = 0; i < 10; i++) leash.advance(wish({}), [0, 0, 0], true, DT);
  expect(leash.target()[0]).toBeCloseTo(lead, 12);
  leash.advance(wish({}), [0.02, 0, 0], true, DT);
  expect(leash.target()[0] - 0.02).toBeLessThanOrEqual(lead + 1e-12);
});

test('turns like the quaternions of the drawing library', () => {
  const a = new Quaternion().setFromAxisAngle(new Vector3(1, 2, 3).normalize(), 0.7);
  const b = new Quaternion().setFromAxisAngle(new Vector3(-1, 0.5, 2).normalize(), 2.1);
  const v = new Vector3(0.3, -0.2, 0.9);
  const turned = rotate(a.toArray() as Quat, v.toArray() as Vec);
  v.clone()
    .applyQuaternion(a)
    .toArray()
    .forEach((x, i) => expect(turned[i]).toBeCloseTo(x, 12));
  for (const limit of [0.05, 0.3, 5]) {
    for (const sign of [1, -1]) {
      const goal = b.toArray().map(x => sign * x) as Quat;
      const mine = new Quaternion(...turnTowards(a.toArray() as Quat, goal, limit));
      expect(mine.angleTo(a.clone().rotateTowards(b, limit))).toBeLessThan(1e-6);
    }
  }
});
