import { expect, test } from 'vitest';
import { Bodies } from '../../src/view/bodies';

const SIZES = Float32Array.from([0.075, 0.025, 0.015]);
const pose = (z: number, ...orientation: number[]) => Float32Array.from([0, 0, z, ...orientation]);

test('the height is that of the last frame where no picture was drawn since', () => {
  const bodies = new Bodies(SIZES, pose(0.0075, 0, 0, 0, 1));
  expect(bodies.top()).toBeCloseTo(0.015, 6);
  for (const z of [0.1, 0.2]) bodies.arrive(pose(z, 0, 0, 0, 1));
  expect(bodies.top()).toBeCloseTo(0.2075, 6);
});

test('the height of a block on its end or its edge is that of its highest corner', () => {
  const half = Math.SQRT1_2;
  expect(new Bodies(SIZES, pose(0.0375, 0, half, 0, half)).top()).toBeCloseTo(0.075, 6);
  expect(new Bodies(SIZES, pose(0.0125, half, 0, 0, half)).top()).toBeCloseTo(0.025, 6);
  const tilted = Math.PI / 12;
  const expected = (0.015 * Math.cos(2 * tilted) + 0.025 * Math.sin(2 * tilted)) / 2;
  expect(new Bodies(SIZES, pose(0, Math.sin(tilted), 0, 0, Math.cos(tilted))).top()).toBeCloseTo(expected, 6);
});
