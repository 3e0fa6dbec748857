// From pixels to metres: along the block where that shows on the screen, towards the viewer is
// down, and never metres for a pixel.

import { expect, test } from 'vitest';
import { axisDisplacement, slideDisplacement, type ProjectedAxis } from '../../src/hand/screen-to-world';

const SCALE = 1000;
const axisOnScreen = (x: number, y: number, towards: number): ProjectedAxis => ({
  screen: { x: x * SCALE, y: y * SCALE },
  towards,
});

test('a block seen from the side follows the pointer', () => {
  const displacement = slideDisplacement({ x: 50, y: 0 }, axisOnScreen(1, 0, 0), axisOnScreen(0, 0.3, 1), SCALE);
  expect(displacement.along).toBeCloseTo(0.05, 3);
  expect(Math.abs(displacement.across)).toBeLessThan(0.005);
});

test('a block whose end faces the viewer comes when the pointer goes down', () => {
  for (const foreshortened of [0.3, 0.05, 0]) {
    const along = axisOnScreen(0, foreshortened, 1);
    const pulled = slideDisplacement({ x: 0, y: 40 }, along, axisOnScreen(1, 0, 0), SCALE);
    expect(pulled.along).toBeGreaterThan(0.04);
    expect(pulled.along, 'no metres for a pixel').toBeLessThan(0.1);
    expect(slideDisplacement({ x: 0, y: -40 }, along, axisOnScreen(1, 0, 0), SCALE).along).toBeCloseTo(
      -pulled.along,
      9,
    );
  }
});

test('sideways motion is possible, and costs more than motion along the block', () => {
  const along = axisOnScreen(0, 0.4, 1);
  const displacement = slideDisplacement({ x: 40, y: 0 }, along, axisOnScreen(1, 0, 0), SCALE);
  expect(displacement.across).toBeGreaterThan(0.005);
  expect(displacement.across).toBeLessThan(0.03);
});

test('one axis alone: only the part of the drag along it counts', () => {
  const axis = axisOnScreen(1, 0, 0);
  expect(axisDisplacement({ x: 30, y: 0 }, axis, SCALE)).toBeCloseTo(0.03, 9);
  expect(axisDisplacement({ x: 0, y: 30 }, axis, SCALE)).toBeCloseTo(0, 9);
  expect(axisDisplacement({ x: -30, y: 0 }, axis, SCALE)).toBeCloseTo(-0.03, 9);
});
