// From pixels to metres: along the block where that shows on the screen, towards the viewer is down, and never metres for a pixel.

import { expect, test } from 'vitest';
import { axisWay, slideWay, type Lever } from '../../src/drag';

const SCALE = 1000;
const lever = (x: number, y: number, towards: number): Lever => ({ screen: { x: x * SCALE, y: y * SCALE }, towards });

test('a block seen from the side follows the pointer', () => {
  const way = slideWay(50, 0, lever(1, 0, 0), lever(0, 0.3, 1), SCALE);
  expect(way.along).toBeCloseTo(0.05, 3);
  expect(Math.abs(way.across)).toBeLessThan(0.005);
});

test('a block whose end faces the viewer comes when the pointer goes down', () => {
  for (const foreshortened of [0.3, 0.05, 0]) {
    const along = lever(0, foreshortened, 1);
    const pulled = slideWay(0, 40, along, lever(1, 0, 0), SCALE);
    expect(pulled.along).toBeGreaterThan(0.04);
    expect(pulled.along, 'no metres for a pixel').toBeLessThan(0.1);
    expect(slideWay(0, -40, along, lever(1, 0, 0), SCALE).along).toBeCloseTo(-pulled.along, 9);
  }
});

test('sideways is possible, and dearer than along', () => {
  const along = lever(0, 0.4, 1);
  const way = slideWay(40, 0, along, lever(1, 0, 0), SCALE);
  expect(way.across).toBeGreaterThan(0.005);
  expect(way.across).toBeLessThan(0.03);
});

test('one axis alone: only the part of the drag along it counts', () => {
  const axis = lever(1, 0, 0);
  expect(axisWay(30, 0, axis, SCALE)).toBeCloseTo(0.03, 9);
  expect(axisWay(0, 30, axis, SCALE)).toBeCloseTo(0, 9);
  expect(axisWay(-30, 0, axis, SCALE)).toBeCloseTo(-0.03, 9);
});
