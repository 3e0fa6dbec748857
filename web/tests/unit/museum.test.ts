// Pure pieces of the museum: distances between towers, and the strip of iterations.

import { expect, test } from 'vitest';
import { millimetres, towerDistance } from '../../src/museum/distance';
import { barHeight, Chart, MAX_BARS } from '../../src/museum/chart';
import { EXHIBITS } from '../../src/museum/catalogue';
import { tower } from './towers';

test('two towers are as far apart as the block that is farthest off', () => {
  const a = tower(['xxx', 'xxx']).newest;
  const b = a.slice();
  expect(towerDistance(a, b)).toMatchObject({ max: 0, mean: 0 });
  b[7 * 4] += 0.003;
  b[7 * 4 + 1] -= 0.004;
  b[7 * 2 + 2] += 0.001;
  const { max, body, mean, each } = towerDistance(a, b);
  expect(body).toBe(4);
  expect(max).toBeCloseTo(0.005, 7);
  expect(mean).toBeCloseTo(0.001, 7);
  expect(each[2]).toBeCloseTo(0.001, 7);
  // A turn in place moves no centre.
  b.set(a);
  b.set([0, 0, 1, 0], 3);
  expect(towerDistance(a, b).max).toBe(0);
  expect([0.000123, 0.0123, 0.123].map(millimetres)).toEqual(['0.12 mm', '12.3 mm', '123 mm']);
});

test('the strip goes with the logarithm up to its limit, and keeps the last pictures', () => {
  expect(barHeight(0, 1000)).toBe(0);
  expect(barHeight(1, 1000)).toBeCloseTo(0.1);
  expect(barHeight(10, 1000)).toBeCloseTo(0.4);
  expect(barHeight(1000, 1000)).toBe(1);
  expect(barHeight(5000, 1000)).toBe(1);
  const chart = new Chart();
  for (let n = 0; n < MAX_BARS + 5; n++) chart.add(n);
  expect(chart.bars.length).toBe(MAX_BARS);
  expect(chart.bars[MAX_BARS - 1]).toBe(MAX_BARS + 4);
  chart.clear();
  expect(chart.bars).toEqual([]);
});

test('every exhibit has a falling and a standing stack', () => {
  for (const { method, sceneries } of EXHIBITS) {
    for (const setting of ['stack', 'falling'] as const)
      expect(
        sceneries.map(s => s.setting),
        method,
      ).toContain(setting);
    expect(sceneries.every(s => s.count >= 1 && s.count <= 16)).toBe(true);
  }
});
