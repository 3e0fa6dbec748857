// The sound of the game in a real browser: what is heard of a fall, and how a knock and a scrape
// differ.

import { build, type Rolldown } from 'vite';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { wavesAt } from '../../src/sound/waves';
import { load } from '../engine.mjs';
import { drop, host, Session, SMALL, type Host } from './browser';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** The instrument as a script, which the built page does not offer by itself. */
async function instrumentText(): Promise<string> {
  const entry = new URL('../../src/sound/instrument.ts', import.meta.url).pathname;
  const lib = { entry, formats: ['iife' as const], name: 'sound' };
  const made = await build({ configFile: false, logLevel: 'silent', build: { write: false, lib } });
  const [{ output }] = made as Rolldown.RolldownOutput[];
  return output[0].code;
}

test('a knock and a scrape differ in the centre of their spectrum, and silence is silent', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`);
  await session.page.addScriptTag({ content: await instrumentText() });
  const measured = await session.page.evaluate(
    async numbers => {
      const { Instrument } = (window as unknown as { sound: typeof import('../../src/sound/instrument') }).sound;
      const [knock, roughness, creak] = numbers.map(wave => Float32Array.from(wave));
      /** Level and centre of the spectrum (Hz) of what an instrument plays. */
      async function hear(play: (instrument: InstanceType<typeof Instrument>) => void) {
        const context = new OfflineAudioContext(1, 12_000, 24_000);
        play(new Instrument(context, 1, { knock, roughness, creak }));
        const samples = (await context.startRendering()).getChannelData(0).subarray(0, 8192);
        let [sum, weighted] = [0, 0];
        for (let k = 1; k < 1024; k++) {
          let [re, im] = [0, 0];
          const step = (2 * Math.PI * k) / 2048;
          for (let i = 0; i < samples.length; i++) {
            re += samples[i] * Math.cos(step * i);
            im += samples[i] * Math.sin(step * i);
          }
          sum += re * re + im * im;
          weighted += (re * re + im * im) * ((k * 24_000) / 2048);
        }
        return { level: Math.hypot(...samples), centre: weighted / sum };
      }
      return {
        silence: await hear(() => undefined),
        soft: await hear(i => i.knock(0.1, 1, 0)),
        knock: await hear(i => i.knock(0.6, 1, 0)),
        scrape: await hear(i => i.scrape(0.6, 3000)),
        slow: await hear(i => i.scrape(0.6, 900)),
        creak: await hear(i => i.creak(0.8)),
        rumble: await hear(i => i.rumble(0.8)),
      };
    },
    Object.values(wavesAt(24_000)).map(wave => [...wave]),
  );
  expect(measured.silence.level).toBe(0);
  expect(measured.knock.level).toBeGreaterThan(2 * measured.soft.level);
  expect(measured.soft.level).toBeGreaterThan(0);
  expect(measured.scrape.centre / measured.knock.centre, 'scrape over knock').toBeGreaterThan(1.8);
  expect(measured.scrape.centre / measured.slow.centre, 'fast over slow').toBeGreaterThan(1.3);
  expect(measured.creak.level).toBeGreaterThan(0);
  expect(measured.rumble.centre).toBeLessThan(0.6 * measured.knock.centre);
});

test('a pile is heard as it falls, mute silences it for good, and nothing sounds before a gesture', async () => {
  await using session = await Session.open(chrome, `${SMALL}&scene=pile&render=once`);
  const { page } = session;
  const sound = () => page.evaluate(() => window.teeter.sound);
  await session.simulate(0.2);
  expect(await sound()).toMatchObject({ state: 'none', knocks: 0 });
  await page.keyboard.press('f');
  await page.waitForFunction(() => window.teeter.sound.state === 'running');
  await session.rebuild(() => page.click('#reset'));
  await session.simulate(1);
  expect((await sound()).knocks, 'knocks of a fall').toBeGreaterThan(5);
  await page.keyboard.press('m');
  expect(await page.getAttribute('#mute', 'aria-pressed')).toBe('true');
  const before = (await sound()).knocks;
  await session.rebuild(() => page.click('#reset'));
  await session.simulate(1);
  expect((await sound()).knocks).toBe(before);
  await page.reload();
  await page.waitForFunction(() => window.teeter?.ready);
  expect(await page.getAttribute('#mute', 'aria-pressed')).toBe('true');
  expect(session.complaints).toEqual([]);
});

test('a replay is heard as the game was, but not where it is scrubbed', async () => {
  const { Game, namedScene } = await load('simd128');
  const game = new Game(namedScene('pile'), JSON.stringify({ sleep: true, frame: 1 / 60 }), '');
  game.startRecord();
  for (let frame = 0; frame < 60; frame++) game.step('');
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`);
  const { page } = session;
  const knocks = () => page.evaluate(() => window.teeter.sound.knocks);
  await page.keyboard.press('f');
  await page.waitForFunction(() => window.teeter.sound.state === 'running');
  await session.rebuild(() => drop(session, game.record(false)!));
  const atEnd = () => window.teeter.replay!.frame === window.teeter.replay!.frames;
  await page.waitForFunction(atEnd);
  const heard = await knocks();
  expect(heard, 'knocks of a fall').toBeGreaterThan(5);
  // From frame to frame over the whole fall, and nothing is played in between.
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.teeter.paused);
  for (const frame of [10, 20, 30, 45, 20, 40]) {
    await page.locator('#replay-scrub').fill(String(frame));
    await page.waitForFunction(frame => window.teeter.replay!.frame === frame, frame);
  }
  expect(await knocks()).toBe(heard);
  expect(session.complaints).toEqual([]);
});
