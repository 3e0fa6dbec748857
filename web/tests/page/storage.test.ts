// A browser that keeps nothing: the page plays on, says once what is lost, and offers the file.

import { readFile } from 'node:fs/promises';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { load } from '../engine.mjs';
import { host, Session, SMALL, type Host } from './browser';
import { drawOut, phase, takeOut } from './hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** Collects the lines that the page shows in `window.lines`. */
const collectLines = () =>
  addEventListener('DOMContentLoaded', () => {
    const lines: string[] = [];
    const note = document.getElementById('notice')!;
    new MutationObserver(() => lines.push(note.firstChild?.textContent ?? '')).observe(note, { childList: true });
    Object.assign(window, { lines });
  });

test.each([
  [
    'refuses storage',
    () => {
      IDBFactory.prototype.open = () => {
        throw new DOMException('storage is denied', 'SecurityError');
      };
    },
  ],
  [
    'has no room left',
    () => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException('the quota is exceeded', 'QuotaExceededError');
      };
    },
  ],
])('in a browser that %s the game goes on, and its file is offered once', async (_, refuse) => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&seed=1&mode=hot-seat`, {
    before: async page => {
      await page.addInitScript(refuse);
      await page.addInitScript(collectLines);
    },
  });
  const { page } = session;
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  await page.waitForSelector('#notice.shown button');
  expect(await page.textContent('#notice')).toMatch(
    /^This browser keeps no games: .* Save it as a file\.Save the gameClose$/,
  );
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#notice button').first().click()]);
  const { Replay } = await load('simd128');
  const replay = new Replay(await readFile(await download.path()));
  while (replay.step() !== undefined);
  expect(replay.isSame).toBe(true);
  expect(replay.frames).toBeGreaterThan(60);

  // A block moves again, which would be saved.
  await page.evaluate(() => (window as unknown as { lines: string[] }).lines.splice(0));
  await drawOut(session, 0);
  await page.mouse.up();
  await session.simulate(2);
  expect(await page.locator('#notice button').count(), 'the offer is gone').toBe(0);
  const lines = await page.evaluate(() => (window as unknown as { lines: string[] }).lines);
  expect(lines.filter(line => line.startsWith('This browser keeps no games'))).toEqual([]);
  expect(session.complaints).toEqual([]);
});
