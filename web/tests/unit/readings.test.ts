// The X-ray's colours and words.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { Bodies } from '../../src/view/bodies';
import { colourOf, forceText, isDark, isLoose, LOOSE, levelOf, readings } from '../../src/xray/readings';
import { SIZE, tower } from './towers';

/** Relative luminance of sRGB. */
const luminance = (rgb: number[]) => {
  const [r, g, b] = rgb.map(c => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};

test('the tighter the darker, all along the scale, and figures stand out against it', () => {
  const forces = Array.from({ length: 60 }, (_, i) => LOOSE * 10 ** (i / 29.5));
  const light = forces.map(force => luminance(colourOf(force)));
  for (let i = 1; i < light.length; i++) expect(light[i], `at ${forces[i]} N`).toBeLessThan(light[i - 1]);
  forces.forEach((force, i) => {
    const contrast = isDark(force) ? 1.05 / (light[i] + 0.05) : (light[i] + 0.05) / 0.05;
    expect(contrast, `contrast at ${force} N`).toBeGreaterThan(3);
  });
  expect([0.01, LOOSE, 1, 10, 100].map(levelOf)).toEqual([0, 0, 0.5, 1, 1]);
});

test('forces are shown in figures that count', () => {
  expect([0.077, 0.5, 0.994, 0.996, 3.94, 9.96].map(forceText)).toEqual(['0.08', '0.50', '0.99', '1.0', '3.9', '10']);
});

test('loose is what starts below a tenth of a newton', () => {
  const all = readings([0, 0.08, 1, 0.3, 0, 0.0999], tower(['xxx']));
  expect(all.map(isLoose)).toEqual([true, false, true]);
  expect(all[1]).toEqual({ load: 1, pull: expect.closeTo(0.3, 6) });
});

test('what lies on nothing, leans or stands on an end or an edge has no pull', () => {
  const turns: [Vector3, number, boolean][] = [
    [new Vector3(0, 0, 1), 1.1, true],
    [new Vector3(1, 0, 0), Math.PI / 2, true],
    [new Vector3(0, 1, 0), 0.05, true],
    [new Vector3(0, 1, 0), 0.3, false],
    [new Vector3(0, 1, 0), Math.PI / 2, false],
    [new Vector3(1, 0, 0), Math.PI / 4, false],
  ];
  for (const [axis, angle, applies] of turns) {
    const rotation = new Quaternion().setFromAxisAngle(axis, angle);
    const bodies = new Bodies(
      Float32Array.from(SIZE.toArray()),
      Float32Array.from([0, 0, 0.05, ...rotation.toArray()]),
    );
    expect(readings([0, 0.08], bodies)[0].pull !== null, `${axis.toArray()} by ${angle}`).toBe(applies);
  }
  expect(readings([0, NaN], tower(['x..']))[0].pull).toBeNull();
});
