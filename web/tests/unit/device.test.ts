// The form of blocks and the stiffness of contacts that a device holds: slower devices and larger
// towers never get stiffer ones nor springs where faster and smaller ones get none, and what play
// shows is believed.

import { expect, test } from 'vitest';
import {
  Device,
  MIN_WITH_SPRINGS,
  load,
  measure,
  measureForm,
  STIFFNESSES,
  maxStiffness,
  CALIBRATION,
} from '../../src/engine/device';
import { FRAME, type Form } from '../../src/engine/game-protocol';

/** A clock that only steps move, and shows whole ticks, s. */
class Clock {
  time = 0;
  steps = 0;
  constructor(readonly tick = 0) {}
  now = () => (this.tick > 0 ? Math.floor(this.time / this.tick) * this.tick : this.time);
  /** A step that takes as long as `cost` says at the time that it begins. */
  step = (cost: (time: number) => number) => () => {
    this.steps += 1;
    this.time += cost(this.time);
  };
}

const COSTS = [1e-5, 1e-4, 5e-4, 1e-3, 2e-3, 3e-3, 5e-3, 8e-3, 0.012, 0.02, 0.1, 1, 10];
const BLOCKS = [1, 9, 18, 54, 90, 120, 600];

test('a slower device and a larger tower never get stiffer contacts', () => {
  for (const blocks of BLOCKS) {
    const chosen = COSTS.map(cost => maxStiffness(cost, blocks));
    expect(chosen, `${blocks} blocks`).toEqual([...chosen].sort((a, b) => b - a));
  }
  for (const cost of COSTS) {
    const chosen = BLOCKS.map(blocks => maxStiffness(cost, blocks));
    expect(chosen, `${cost} s a frame`).toEqual([...chosen].sort((a, b) => b - a));
  }
  expect(new Set(COSTS.map(cost => maxStiffness(cost, 54))), 'each of the three is somewhere the right one').toEqual(
    new Set(STIFFNESSES),
  );
});

test('the fastest device gets the stiffest contacts, and the slowest the softest', () => {
  expect(maxStiffness(0, 54)).toBe(3e6);
  expect(maxStiffness(1e-4, 54)).toBe(3e6);
  for (const cost of [0.05, 1000, Infinity, NaN]) expect(maxStiffness(cost, 54)).toBe(3e5);
});

test('what is chosen leaves a frame of three times the cost of the trial in real time, and the next stiffer one would not', () => {
  for (const blocks of BLOCKS) {
    for (const cost of COSTS) {
      const chosen = maxStiffness(cost, blocks);
      const stiffer = STIFFNESSES[STIFFNESSES.indexOf(chosen) + 1];
      if (chosen > STIFFNESSES[0]) expect(3 * cost * load(blocks, chosen)).toBeLessThan(FRAME);
      if (stiffer) expect(4 * cost * load(blocks, stiffer)).toBeGreaterThan(FRAME);
    }
  }
});

test('the load is that of the trial for the tower of the trial, and grows with blocks and with the root of stiffness', () => {
  expect(load(CALIBRATION.blocks, CALIBRATION.stiffness)).toBe(1);
  expect(load(120, 1e6)).toBeCloseTo(120 / 54, 9);
  expect(load(54, 4e6)).toBeCloseTo(2, 9);
});

test('the cost of a step is that of the quickest stretch: a busy machine and code not yet compiled do not count', () => {
  const clock = new Clock();
  const cost = measure(
    clock.step(time => (time < 0.1 ? 0.016 : time < 0.15 ? 0.009 : 0.004)),
    clock.now,
  );
  expect(cost).toBeCloseTo(0.004, 9);
});

test('measuring takes a quarter of a second, a whole one on a slow device, and a step where that takes longer', () => {
  const took = (cost: number) => {
    const clock = new Clock();
    expect(
      measure(
        clock.step(() => cost),
        clock.now,
      ),
    ).toBeCloseTo(cost, 9);
    return clock.time;
  };
  expect(took(0.001)).toBeLessThan(0.3);
  expect(took(0.02)).toBeGreaterThan(0.9);
  expect(took(0.02)).toBeLessThan(1.1);
  expect(took(30)).toBe(30);
});

test('a clock of coarse ticks gives nearly the same cost', () => {
  for (const tick of [1e-4, 1e-3, 0.016, 0.1]) {
    const clock = new Clock(tick);
    const cost = measure(
      clock.step(() => 0.003),
      clock.now,
    );
    expect(cost / 0.003, `ticks of ${tick} s`).toBeGreaterThan(0.8);
    expect(cost / 0.003, `ticks of ${tick} s`).toBeLessThan(1.2);
  }
});

/** The stiffness chosen for a tower of rigid blocks, N/m. */
const rigid = (device: Device, blocks: number) =>
  device.choose(blocks, { form: 'rigid', stiffness: null, springs: null }).stiffness;

test('a device is measured once with each form, and only when it is asked', () => {
  const trials: Form[] = [];
  const device = new Device(form => {
    trials.push(form);
    return 0.003;
  });
  expect(trials).toEqual([]);
  expect([rigid(device, 54), rigid(device, 120), rigid(device, 18)]).toEqual([1e6, 3e5, 3e6]);
  expect(trials).toEqual(['rigid']);
  device.choose(54);
  device.choose(18);
  expect(trials).toEqual(['rigid', 'lattice']);
  device.choose(54, { form: 'lattice', stiffness: 1e6, springs: null });
  expect(trials, 'what is named needs no trial').toEqual(['rigid', 'lattice']);
});

test('a device that holds springs is not measured with rigid blocks', () => {
  const trials: Form[] = [];
  const device = new Device(form => {
    trials.push(form);
    return 0.002;
  });
  expect(device.choose(54)).toEqual({ form: 'lattice', stiffness: 3e6 });
  expect(trials).toEqual(['lattice']);
});

/**
 * A device on which a frame costs so much with rigid blocks, and seven times as much with springs.
 */
const sprung = (cost: number) => new Device(form => (form === 'lattice' ? 7 : 1) * cost);

test('blocks have springs inside where the device holds them, and are rigid on slower devices and in larger towers', () => {
  for (const blocks of BLOCKS) {
    const forms = COSTS.map(cost => sprung(cost).choose(blocks).form);
    expect(forms, `${blocks} blocks`).toEqual([...forms].sort());
  }
  expect(sprung(1e-4).choose(54)).toEqual({ form: 'lattice', stiffness: 3e6 });
  expect(sprung(8e-4).choose(54)).toEqual({ form: 'lattice', stiffness: 1e6 });
  expect(sprung(1e-3).choose(54)).toEqual({ form: 'rigid', stiffness: 3e6 });
  expect(sprung(1e-3).choose(18).form).toBe('lattice');
  expect(sprung(NaN).choose(54)).toEqual({ form: 'rigid', stiffness: STIFFNESSES[0] });
});

test('springs are chosen only with contacts that separate loose from tight, and leave a frame of twice the cost of the trial in real time', () => {
  for (const cost of COSTS) {
    const { form, stiffness } = sprung(cost).choose(54);
    if (form === 'rigid') continue;
    expect(stiffness).toBeGreaterThanOrEqual(MIN_WITH_SPRINGS);
    expect(2 * 7 * cost * load(54, stiffness, stiffness)).toBeLessThan(FRAME);
  }
});

test('what is named is kept, and the rest is chosen for it', () => {
  const slow = sprung(5e-3);
  expect(slow.choose(54, { form: 'lattice', stiffness: null, springs: null })).toEqual({
    form: 'lattice',
    stiffness: 3e5,
  });
  expect(slow.choose(54, { form: null, stiffness: 3e6, springs: null })).toEqual({ form: 'rigid', stiffness: 3e6 });
  const fair = sprung(8e-4);
  expect(fair.choose(54, { form: null, stiffness: 1e6, springs: null }).form).toBe('lattice');
  expect(fair.choose(54, { form: null, stiffness: 3e6, springs: null }).form).toBe('rigid');
  expect(
    fair.choose(54, { form: null, stiffness: null, springs: 3e7 }).form,
    'springs that take a shorter substep',
  ).toBe('rigid');
  expect(fair.choose(54, { form: null, stiffness: null, springs: 1e3 }).form).toBe('lattice');
});

test('soft springs leave the substep to the contacts, stiff ones bound it', () => {
  expect(load(54, 1e6, 1e6)).toBe(load(54, 1e6));
  expect(load(54, 1e6, 1e3)).toBe(load(54, 1e6, 1e5));
  expect(load(54, 1e6, 1e3)).toBeLessThan(load(54, 1e6));
  expect(load(54, 1e6, 1e8)).toBeCloseTo(10, 9);
});

test('springs that a device will never hold are not measured for long', () => {
  const took = (form: Form) => {
    const clock = new Clock();
    const cost = measureForm(
      form,
      clock.step(() => 0.1),
      clock.now,
    );
    expect(cost).toBeCloseTo(0.1, 9);
    return clock.time;
  };
  expect(took('lattice')).toBeLessThan(0.35);
  expect(took('rigid')).toBeGreaterThan(0.9);
});

/** Seconds of play of 60 steps that take as long as `cost` says. */
function play(
  device: Device,
  seconds: number,
  stiffness: number,
  cost: (step: number) => number,
  form: Form = 'rigid',
): void {
  device.begin();
  for (let i = 0; i < 60 * seconds; i++)
    device.played(cost(i), 54, stiffness, form, form === 'lattice' ? stiffness : null);
}

test('where play falls behind, the next tower gets softer contacts, down to the softest', () => {
  const device = new Device(() => 1e-3);
  expect(rigid(device, 54)).toBe(3e6);
  play(device, 2, 3e6, () => 1.1 * FRAME);
  expect(rigid(device, 54)).toBe(1e6);
  play(device, 2, 1e6, () => 1.1 * FRAME);
  expect(rigid(device, 54)).toBe(3e5);
  play(device, 2, 3e5, () => 5 * FRAME);
  expect(rigid(device, 54)).toBe(3e5);
});

test('play that keeps up, a hiccup, or half a second of slowness change nothing', () => {
  const device = new Device(() => 1e-3);
  play(device, 20, 3e6, () => 0.95 * FRAME);
  play(device, 5, 3e6, step => (step % 10 === 0 ? 3 : 0.002));
  for (let i = 0; i < 5; i++) play(device, 0.5, 3e6, () => 2 * FRAME);
  expect(rigid(device, 54)).toBe(3e6);
});

test('where play with springs falls behind, the next tower is rigid, as stiff as before', () => {
  const device = sprung(3e-4);
  expect(device.choose(54)).toEqual({ form: 'lattice', stiffness: 3e6 });
  play(device, 2, 3e6, () => 1.1 * FRAME, 'lattice');
  expect(device.choose(54)).toEqual({ form: 'lattice', stiffness: 1e6 });
  play(device, 2, 1e6, () => 1.1 * FRAME, 'lattice');
  expect(device.choose(54)).toEqual({ form: 'rigid', stiffness: 3e6 });
});
