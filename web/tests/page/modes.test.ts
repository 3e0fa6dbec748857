// The modes of play and a replay, at the sizes of phones and desktops, in each language: nothing is
// cut off, and axe-core finds nothing by light and dark.

import { afterAll, beforeAll, expect, test } from 'vitest';
import load, * as engine from '../../src/wasm/teeter_wasm.js';
import { bytes } from '../engine.mjs';
import { findings } from './axe';
import { drop, host, Session, SMALL, type Host } from './browser';
import { beginDaily } from './daily-game';
import { renamed } from './forgery';
import { findProblems, wide } from './layout';

const DAY = '2026-03-09';
const FRAMES = 30;

let chrome: Host;
/** A game on the tower of the day, and one on a low tower whose engine is missing. */
let daily: Uint8Array, missing: Uint8Array;
beforeAll(async () => {
  const { memory } = await load({ module_or_path: await bytes('simd128') });
  const game = beginDaily(DAY, memory);
  const low = new engine.Game(engine.towerScene('{"rows": 3}'), '', engine.Game.rules('official', 1));
  low.startRecord();
  for (let frame = 0; frame < FRAMES; frame++) {
    game.step({ command: 'idle' });
    low.step('');
  }
  daily = game.record(false)!.bytes;
  missing = await renamed(low.record(false)!, engine.engineId().replace(/.{16}$/, '6'.repeat(16)));
  chrome = await host();
}, 600_000);
afterAll(() => chrome?.stop());

/** Problems of the page as it stands, in the layout of its `parts` and by light and dark. */
async function problemsOf({ page }: Session, ...parts: string[]): Promise<string[]> {
  const found = await findProblems(page);
  for (const part of parts) found.push(...(await wide(page, part)).map(line => `cut off: ${line}`));
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    found.push(...(await findings(page)).map(line => `${colorScheme}: ${line}`));
  }
  return found;
}

test.each([
  [390, 844, 'en'],
  [844, 390, 'en'],
  [1280, 800, 'en'],
  [390, 844, 'de'],
  [844, 390, 'de'],
])('at %i x %i in %s no mode has a problem', async (width, height, lang) => {
  const phone = width < 1000;
  await using session = await Session.open(chrome, `${SMALL}&mode=daily&render=once&lang=${lang}`, {
    viewport: { width, height },
    hasTouch: phone,
    isMobile: phone,
    before: page => page.clock.setSystemTime(`${DAY}T12:00:00Z`),
  });
  const { page } = session;
  await page.waitForSelector('#turn:not([hidden])');
  expect(await problemsOf(session, '#turn'), 'on the tower of the day').toEqual([]);

  await drop(session, daily, 'Wilhelmina von Rothenburg.record');
  await page.waitForSelector('#rank[open]');
  expect(await problemsOf(session, '#rank'), 'before a game is ranked').toEqual([]);
  await page.click('#rank-it');
  await page.waitForFunction(() => window.teeter.ghost !== null);
  await page.click('#menu-open');
  await page.click('[data-mode="daily"]');
  await page.waitForSelector('.ranking li');
  expect(await problemsOf(session, '#menu'), 'in the ranking').toEqual([]);
  await page.click('#menu-resign');
  await page.waitForSelector('#end[open] .ranking li');
  expect(await problemsOf(session, '#end'), 'at the end of the day').toEqual([]);
  await page.click('#end-other');
  await page.click('[data-mode="practice"]');
  await page.locator('#match-rows').fill('3');
  await session.rebuild(() => page.click('#match-start'));
  await page.waitForSelector('#undo');
  expect(await problemsOf(session, '#turn'), 'in practice').toEqual([]);

  await session.rebuild(() => drop(session, missing));
  await page.waitForSelector('#replay-note:not([hidden])');
  expect(await problemsOf(session, '#replay'), 'in a replay').toEqual([]);
  await session.rebuild(() => page.click('#replay-challenge'));
  await page.waitForSelector('#turn:not([hidden])');
  expect(await problemsOf(session, '#turn'), 'in a challenge').toEqual([]);
});
