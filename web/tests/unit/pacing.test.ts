// Time: steps are due at the rate of the clock, time that cannot be caught up is dropped, and never
// a step.

import { expect, test } from 'vitest';
import { Blend, Pace, Rate, Speedometer } from '../../src/engine/pacing';

const FRAME = 1 / 60;
const drain = (pace: Pace) => {
  let steps = 0;
  while (pace.take()) steps += 1;
  return steps;
};

test('a second of wall time in any portions makes sixty steps', () => {
  for (const portions of [10, 60, 144, 1000]) {
    const pace = new Pace(FRAME, 1);
    let steps = 0;
    for (let i = 0; i <= portions; i++) {
      pace.advance(5 + i / portions);
      steps += drain(pace);
    }
    expect(steps, `${portions} portions`).toBe(60);
  }
});

test('what cannot be caught up is dropped', () => {
  const pace = new Pace(FRAME, 4 * FRAME);
  pace.advance(0);
  pace.advance(10);
  expect(drain(pace)).toBe(4);
  pace.advance(10 + FRAME / 2);
  expect(drain(pace)).toBe(0);
  expect(pace.wait()).toBeCloseTo(FRAME / 2, 9);
});

test('a pause leaves nothing owed, and a clock that goes back does no harm', () => {
  const pace = new Pace(FRAME, 1);
  pace.advance(0);
  pace.advance(0.5);
  pace.restart();
  pace.advance(9);
  expect(drain(pace)).toBe(0);
  pace.advance(8);
  expect(drain(pace)).toBe(0);
});

test('the speedometer measures simulated time per wall time and per time spent', () => {
  const meter = new Speedometer(1);
  expect(meter.factor()).toBe(1);
  // Steps of 1/60 s every 1/30 s that cost 5 ms each: half speed, and 3.3 times real time if
  // nothing else were to do.
  for (let i = 0; i < 200; i++) meter.add(i / 30, FRAME, 0.005);
  expect(meter.factor()).toBeCloseTo(0.5, 6);
  expect(meter.capacity()).toBeCloseTo(FRAME / 0.005, 6);
});

test('the picture goes evenly from the older to the newer state and stops there', () => {
  const blend = new Blend(FRAME);
  for (let i = 0; i < 50; i++) blend.arrive(1 + i * FRAME);
  const last = 1 + 49 * FRAME;
  expect(blend.at(last)).toBe(0);
  expect(blend.at(last + FRAME / 2)).toBeCloseTo(0.5, 6);
  expect(blend.at(last + 3 * FRAME)).toBe(1);
});

test('a rate is events per second', () => {
  const rate = new Rate();
  expect(rate.perSecond()).toBe(0);
  for (let i = 0; i < 100; i++) rate.add(i / 50);
  expect(rate.perSecond()).toBeCloseTo(50, 6);
});
