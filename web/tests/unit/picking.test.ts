// Picking of blocks.

import { Vector3 } from 'three';
import { expect, test } from 'vitest';
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
