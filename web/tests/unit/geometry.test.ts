// Geometry of blocks: picking, free blocks, and symmetric orientations.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { isFree } from '../../src/hand/control/free-block';
import { levelled, nearestSymmetric } from '../../src/hand/control/orientations';
import { pick } from '../../src/view/picking';
import { SIZE, tower } from './towers';

test('a ray hits the nearest block, on the face towards its origin', () => {
  const bodies = tower(['xxx', 'xxx']);
  const hit = pick(bodies, new Vector3(1, 0, 0.009), new Vector3(-1, 0, 0))!;
  expect(hit.body).toBe(1);
  expect(hit.point.x).toBeCloseTo(SIZE.x / 2, 6);
  expect(hit.normal.x).toBeCloseTo(1, 9);
  expect(hit.anchor.x).toBeCloseTo(SIZE.x / 2, 6);
  const above = pick(bodies, new Vector3(0, 0, 1), new Vector3(0, 0, -1))!;
  expect(above.body).toBe(4);
  expect(above.normal.z).toBeCloseTo(1, 9);
  expect(pick(bodies, new Vector3(1, 0, 0.2), new Vector3(-1, 0, 0))).toBeNull();
  expect(pick(bodies, new Vector3(1, 0, 0.009), new Vector3(1, 0, 0)), 'not behind the eye').toBeNull();
});

test('only a block with nothing above it can be lifted', () => {
  const bodies = tower(['xxx', 'xxx', 'x..']);
  expect([0, 1, 2].map(b => isFree(bodies, b))).toEqual([false, false, false]);
  // The block on the third row lies across all of the second.
  expect([3, 4, 5].map(b => isFree(bodies, b))).toEqual([false, false, false]);
  expect(isFree(bodies, 6)).toBe(true);
});

test('a block is free once it has come out of the tower, and not before', () => {
  const bodies = tower(['xxx', 'xxx', 'xxx']);
  const out = (x: number) => {
    bodies.newest[7] = x;
    return isFree(bodies, 1);
  };
  expect(out(0.04)).toBe(false);
  expect(out(0.075)).toBe(false);
  expect(out(0.083)).toBe(true);
});

test('the nearest of the symmetric orientations is chosen', () => {
  const z = (a: number) => new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), a);
  expect(nearestSymmetric(z(0), z(3)).angleTo(z(Math.PI))).toBeLessThan(1e-6);
  expect(nearestSymmetric(z(0), z(0.2)).angleTo(z(0))).toBeLessThan(1e-6);
  const over = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), Math.PI - 0.1);
  expect(nearestSymmetric(z(0), over).angleTo(over)).toBeCloseTo(0.1, 6);
});

test('a block that lies nearly flat is levelled, one on its side is left', () => {
  const tilt = (a: number) => new Quaternion().setFromAxisAngle(new Vector3(1, 1, 0).normalize(), a);
  const up = (q: Quaternion) => new Vector3(0, 0, 1).applyQuaternion(q).z;
  expect(up(levelled(tilt(0.2), 0.3))).toBeCloseTo(1, 9);
  expect(up(levelled(tilt(Math.PI - 0.2), 0.3))).toBeCloseTo(-1, 9);
  expect(levelled(tilt(1.2), 0.3).angleTo(tilt(1.2))).toBeLessThan(1e-6);
});
