// The hand's target: limited speed, limited lead, and no gain of lead at full force.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { TargetLimiter, type Goal } from '../../src/hand/control/target-limiter';
import type { Quat, Vec } from '../../src/engine/game-protocol';
import { rotate, rotateTowards } from '../../src/hand/control/vectors';

const goal = (change: Partial<Goal>): Goal => ({
  target: [1, 0, 0],
  orientation: null,
  speed: 0.25,
  lead: 0.012,
  ...change,
});
const DT = 1 / 60;

test('moves at its speed and no faster, and arrives exactly', () => {
  const limiter = new TargetLimiter([0, 0, 0], [0, 0, 0, 1]);
  const far = goal({ target: [0.01, 0, 0], lead: 1 });
  limiter.advance(far, [0, 0, 0], false, DT);
  expect(limiter.target()[0]).toBeCloseTo(0.25 * DT, 12);
  for (let i = 0; i < 10; i++) limiter.advance(far, [0, 0, 0], false, DT);
  expect(limiter.target()).toEqual([0.01, 0, 0]);
});

test('stays within its lead of a point that sticks', () => {
  const limiter = new TargetLimiter([0, 0, 0], [0, 0, 0, 1]);
  for (let i = 0; i < 60; i++) limiter.advance(goal({}), [0, 0, 0], false, DT);
  expect(limiter.target()[0]).toBeCloseTo(0.012, 9);
});

test('gains no lead at full force, and follows when the point comes loose', () => {
  const limiter = new TargetLimiter([0, 0, 0], [0, 0, 0, 1]);
  limiter.advance(goal({}), [0, 0, 0], false, DT);
  const lead = limiter.target()[0];
  for (let i = 0; i < 10; i++) limiter.advance(goal({}), [0, 0, 0], true, DT);
  expect(limiter.target()[0]).toBeCloseTo(lead, 12);
  limiter.advance(goal({}), [0.02, 0, 0], true, DT);
  expect(limiter.target()[0] - 0.02).toBeLessThanOrEqual(lead + 1e-12);
});

test('rotates like the quaternions of three.js', () => {
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
      const end = b.toArray().map(x => sign * x) as Quat;
      const mine = new Quaternion(...rotateTowards(a.toArray() as Quat, end, limit));
      expect(mine.angleTo(a.clone().rotateTowards(b, limit))).toBeLessThan(1e-6);
    }
  }
});
