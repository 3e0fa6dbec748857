// Rest: slow, without a hand, and with forces that stay.

import { expect, test } from 'vitest';
import { RestDetector, type Motion } from '../../src/hand/control/rest-detector';

const rest: Motion = { speed: 1e-5, held: false, form: 'rigid', springs: null };

/** Steps at which rest begins (positive) and ends (negative), for steps from 1 on. */
function changes(
  detector: RestDetector,
  steps: number,
  motion: (step: number) => Motion,
  forces: (step: number) => number[],
): number[] {
  const seen: number[] = [];
  for (let step = 1; step <= steps; step++) {
    const before = detector.atRest;
    detector.advance(motion(step), () => Float32Array.from(forces(step)));
    if (detector.atRest !== before) seen.push(detector.atRest ? step : -step);
  }
  return seen;
}

test('two looks at the same forces are rest, also where a block has none', () => {
  const [begun, ...more] = changes(
    new RestDetector(),
    200,
    () => rest,
    () => [1, NaN],
  );
  expect(begun).toBeLessThanOrEqual(45);
  expect(more).toEqual([]);
});

test('no rest while weight comes on, however slowly all moves', () => {
  const [begun] = changes(
    new RestDetector(),
    200,
    () => rest,
    step => [Math.min(step, 100) / 10],
  );
  expect(begun).toBeGreaterThan(100);
  expect(begun).toBeLessThanOrEqual(145);
});

test.each<[string, Partial<Motion>]>([
  ['a blow', { speed: 0.1 }],
  ['a hand', { held: true }],
  ['springs', { form: 'lattice', springs: 1e6 }],
])('%s ends rest at once, and it begins anew', (_, change) => {
  const motion = (step: number) => (step === 100 ? { ...rest, ...change } : rest);
  const seen = changes(new RestDetector(), 200, motion, () => [1]);
  expect(seen.length).toBe(3);
  expect(seen[1]).toBe(-100);
  expect(seen[2]).toBeGreaterThan(115);
});

test('forces that creep are seen', () => {
  const seen = changes(
    new RestDetector(),
    1000,
    () => rest,
    step => [1 + step * 1e-4],
  );
  expect(seen.length).toBeGreaterThan(3);
});
