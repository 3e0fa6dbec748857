// The camera shows the whole tower where no control covers it.

import { Vector3 } from 'three';
import { expect, test } from 'vitest';
import { Orbit } from '../../src/view/orbit';

/** Half the width of a row, m. */
const HALF = 0.0375;
const ROW = 0.015;

/** Heights of the controls above and below the tower, px, as the style sheet lays them out. */
const PICTURES = [
  { name: 'a phone on its side', width: 844, height: 390, above: 0, below: 71 },
  { name: 'a small phone on its side', width: 667, height: 375, above: 0, below: 71 },
  { name: 'the smallest phone on its side', width: 568, height: 320, above: 0, below: 71 },
  { name: 'a phone', width: 390, height: 844, above: 110, below: 140 },
  { name: 'a small phone', width: 320, height: 568, above: 110, below: 140 },
  { name: 'a screen', width: 1280, height: 720, above: 0, below: 71 },
];

for (const { name, width, height, above, below } of PICTURES) {
  test.each([18, 3, 40])(`on ${name} no control covers a tower of %i rows`, rows => {
    const orbit = new Orbit(true);
    orbit.resize(width, height);
    for (const azimuth of [-0.9, 0, 2]) {
      orbit.frame(rows * ROW, azimuth);
      isClear(orbit, rows);
    }
  });

  test(`a tower stays whole when the picture becomes that of ${name}`, () => {
    for (const from of PICTURES) {
      const orbit = new Orbit(true);
      orbit.resize(from.width, from.height);
      orbit.frame(18 * ROW, -0.9);
      orbit.resize(width, height);
      while (orbit.update(1));
      isClear(orbit, 18);
    }
  });

  function isClear(orbit: Orbit, rows: number): void {
    for (const x of [-HALF, HALF]) {
      for (const y of [-HALF, HALF]) {
        const foot = orbit.project(new Vector3(x, y, 0));
        const head = orbit.project(new Vector3(x, y, rows * ROW));
        expect(foot.y).toBeLessThan(height - below);
        expect(head.y).toBeGreaterThan(above);
        for (const end of [foot, head]) {
          expect(end.x).toBeGreaterThan(0);
          expect(end.x).toBeLessThan(width);
        }
      }
    }
  }
}

test('a picture that changes its shape does not undo a zoom', () => {
  const orbit = new Orbit(true);
  orbit.resize(390, 844);
  orbit.frame(18 * ROW, -0.9);
  const pixels = (height: number) => {
    while (orbit.update(1));
    const at = (z: number) => orbit.project(new Vector3(0, 0, z)).y;
    return (at(0.1) - at(0.16)) / height;
  };
  const whole = pixels(844);
  orbit.zoom(0.5);
  const near = pixels(844) / whole;
  orbit.resize(844, 390);
  const turned = pixels(390);
  orbit.resize(390, 844);
  expect(pixels(844) / whole).toBeCloseTo(near, 6);
  orbit.zoom(2);
  orbit.resize(844, 390);
  expect(turned / pixels(390)).toBeGreaterThan(1.6);
});
