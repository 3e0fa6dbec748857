// The scale of forces follows calmly, and the dial of stiffness goes by factors.

import { expect, test } from 'vitest';
import { DIAL, snapped, newtonsPerMillimetre, stepOf, stiffnessAt } from '../../src/ui/springs-dial';
import { forceAt, ForceScale, formatForce, unitOf } from '../../src/view/force-scale';

test('the first force is taken as it is, later ones are followed: up soon, down slowly', () => {
  const scale = new ForceScale();
  scale.follow(2, 0.016);
  expect(scale.end).toBe(2);
  for (let i = 0; i < 30; i++) scale.follow(8, 1 / 60);
  expect(scale.end).toBeGreaterThan(7.5);
  for (let i = 0; i < 30; i++) scale.follow(2, 1 / 60);
  expect(scale.end, 'half a second after an impact').toBeGreaterThan(5);
  for (let i = 0; i < 300; i++) scale.follow(2, 1 / 60);
  expect(scale.end).toBeCloseTo(2, 0);
  scale.reset();
  scale.follow(0, 1 / 60);
  expect(scale.end, 'never nothing').toBeGreaterThan(0);
});

test('the picture does not depend on the rate of frames', () => {
  const end = (rate: number) => {
    const scale = new ForceScale();
    scale.follow(1, 0);
    for (let i = 0; i < rate / 2; i++) scale.follow(3, 1 / rate);
    return scale.end;
  };
  expect(end(30)).toBeCloseTo(end(144), 6);
});

test('a level of the scale has its force, with the square root of the force between them', () => {
  for (const force of [-3, -0.4, 0, 0.01, 2.9])
    expect(forceAt(Math.sign(force) * Math.sqrt(Math.abs(force) / 3), 3)).toBeCloseTo(force, 12);
  expect(forceAt(-0.5, 3)).toBeCloseTo(-0.75, 12);
  expect([-1, 1].map(end => forceAt(end, 3))).toEqual([-3, 3]);
});

test('forces are shown in two figures', () => {
  expect([3.2024, -0.80061, 0, 12.34].map(force => formatForce(force, 'N'))).toEqual(['3.2', '0.8', '0', '12']);
  expect(formatForce(0.00456, 'mN')).toBe('4.6');
  expect([unitOf(2), unitOf(0.02)]).toEqual(['N', 'mN']);
});

test('the dial goes from jelly to wood by equal factors, and each step is its own', () => {
  expect(stiffnessAt(0)).toBe(DIAL.min);
  expect(stiffnessAt(DIAL.steps)).toBe(DIAL.max);
  for (let step = 0; step <= DIAL.steps; step++) expect(stepOf(stiffnessAt(step))).toBe(step);
  expect(stepOf(1)).toBe(0);
  expect(stepOf(1e9)).toBe(DIAL.steps);
});

test('near to the contacts the dial means as stiff as they are', () => {
  for (const contacts of [3e5, 1e6, 3e6]) expect(snapped(stiffnessAt(stepOf(contacts)), contacts)).toBeNull();
  expect(snapped(1e3, 1e6)).toBe(1e3);
  expect(newtonsPerMillimetre(1e3)).toBe('1 N/mm');
  expect(newtonsPerMillimetre(3e7)).toBe('30000 N/mm');
});
