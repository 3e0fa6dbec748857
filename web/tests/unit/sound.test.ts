// Sound as numbers: louder for more, limited in voices, and a scrape that differs from a knock.

import { expect, test } from 'vitest';
import {
  creakGain,
  IMPULSE,
  knockGain,
  pitchOf,
  POWER,
  rumbleGain,
  scrapeBand,
  scrapeGain,
} from '../../src/sound/levels';
import { readSounds, SOUND_STRIDE } from '../../src/sound/sounds';
import { Voices, VOICES } from '../../src/sound/voices';
import { creak, knock, roughness } from '../../src/sound/waves';

const RATE = 24_000;
const levels = (min: number, max: number) => Array.from({ length: 60 }, (_, i) => min * (max / min) ** (i / 59));

test.each([
  ['knock', knockGain, IMPULSE],
  ['scrape', scrapeGain, POWER],
] as const)('the gain of a %s grows with its cause from silence to one', (_, gain, { min, max }) => {
  const gains = levels(min / 4, 4 * max).map(gain);
  expect(gains).toEqual([...gains].sort((a, b) => a - b));
  expect([gain(0), gain(min), gain(max), gain(1e9)]).toEqual([0, 0, 1, 1]);
  const within = levels(1.01 * min, max).map(gain);
  for (let i = 1; i < within.length; i++) expect(within[i]).toBeGreaterThan(within[i - 1]);
});

test('a faster scrape is higher, and a block keeps its own pitch', () => {
  const bands = levels(1e-4, 10).map(scrapeBand);
  expect(bands).toEqual([...bands].sort((a, b) => a - b));
  expect(bands.at(-1)! / bands[0]).toBeGreaterThan(4);
  const pitches = Array.from({ length: 54 }, (_, body) => pitchOf(body));
  expect(new Set(pitches).size).toBe(54);
  expect(Math.max(...pitches) / Math.min(...pitches)).toBeLessThan(1.5);
});

test('wood creaks while its load grows near the limit, and not while it slides, rests or is eased', () => {
  const strained = { force: 0.8, change: 0.02, speed: 0 };
  expect(creakGain(strained)).toBeGreaterThan(0.5);
  expect(creakGain({ ...strained, force: 0.9 })).toBeGreaterThan(creakGain(strained));
  for (const quiet of [{ force: 0.2 }, { change: 0 }, { change: -0.1 }, { speed: 0.02 }])
    expect(creakGain({ ...strained, ...quiet })).toBe(0);
});

test('two knocks are no collapse, and many hard ones are', () => {
  expect(rumbleGain(1, 2)).toBe(0);
  expect(rumbleGain(0.1, 8)).toBe(1);
  expect(rumbleGain(0.02, 5)).toBeLessThan(rumbleGain(0.04, 5));
});

test('no more voices sound at once than the limit, the loudest first, and more when they have ended', () => {
  const voices = new Voices();
  const impacts = Array.from({ length: 40 }, (_, body) => ({ body, gain: (1 + ((7 * body) % 40)) / 40 }));
  const first = voices.choose(impacts, 0);
  expect(first).toHaveLength(VOICES);
  expect(first.map(({ gain }) => gain)).toEqual(first.map((_, i) => (40 - i) / 40));
  const rest = impacts.filter(impact => !first.includes(impact));
  expect(voices.choose(rest, 0.01)).toEqual([]);
  expect(voices.choose(rest, 1)).toHaveLength(VOICES);
});

test('the bounces of a block within an instant are one knock, and silence takes no voice', () => {
  const voices = new Voices();
  const hit = { body: 3, gain: 0.5 };
  expect(voices.choose([hit], 0)).toEqual([hit]);
  expect(voices.choose([hit], 0.02)).toEqual([]);
  expect(voices.choose([hit], 0.2)).toEqual([hit]);
  expect(voices.choose([{ body: 4, gain: 0 }], 0.3)).toEqual([]);
});

/** Centre of the spectrum of a wave, Hz, by a discrete Fourier transform of its first part. */
function centroid(wave: Float32Array): number {
  const length = Math.min(wave.length, 2048);
  let [sum, weighted] = [0, 0];
  for (let k = 1; k < length / 2; k++) {
    let [re, im] = [0, 0];
    for (let i = 0; i < length; i++) {
      re += wave[i] * Math.cos((2 * Math.PI * k * i) / length);
      im -= wave[i] * Math.sin((2 * Math.PI * k * i) / length);
    }
    const power = re * re + im * im;
    sum += power;
    weighted += power * ((k * RATE) / length);
  }
  return weighted / sum;
}

test('a knock rings low and dies, rough faces hiss and go on without a seam', () => {
  const [hit, rough] = [knock(RATE), roughness(RATE)];
  expect(centroid(rough)).toBeGreaterThan(2 * centroid(hit));
  const energy = (wave: Float32Array) => wave.reduce((sum, value) => sum + value * value, 0);
  const tail = hit.subarray(hit.length / 2);
  expect(energy(tail)).toBeLessThan(1e-3 * energy(hit));
  const second = (from: number) => energy(rough.subarray(from, from + 0.2 * RATE));
  expect(second(RATE) / second(0)).toBeGreaterThan(0.3);
  const seam = Math.abs(rough[0] - rough[rough.length - 1]);
  const steps = rough.map((value, i) => Math.abs(value - (rough[i - 1] ?? value)));
  expect(seam).toBeLessThanOrEqual(Math.max(...steps));
});

test.each([
  ['knock', knock],
  ['roughness', roughness],
  ['creak', creak],
] as const)('the wave of a %s fills its range, is the same in each run, and has no offset', (_, wave) => {
  const made = wave(RATE);
  expect(Math.max(...made.map(Math.abs))).toBeCloseTo(1, 6);
  expect(wave(RATE)).toEqual(made);
  expect(Math.abs(made.reduce((sum, value) => sum + value, 0) / made.length)).toBeLessThan(0.02);
});

test('the numbers of a frame are read as impacts and slides', () => {
  const numbers = [0, 5, 0.01, 0.4, 0.1, 0.2, 0.3, 1, 6, 0.5, 0.02, 0, 0, 0.1];
  expect(numbers.length % SOUND_STRIDE).toBe(0);
  expect(readSounds(numbers)).toEqual({
    impacts: [{ body: 5, strength: 0.01, speed: 0.4, point: [0.1, 0.2, 0.3] }],
    slides: [{ body: 6, strength: 0.5, speed: 0.02, point: [0, 0, 0.1] }],
  });
});
