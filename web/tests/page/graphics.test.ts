// The page and the museum in a real browser whose graphics are taken away and given back, and the
// page with an engine that takes long.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { contrast, host, Session, SMALL, type Host } from './browser';
import * as museum from './museum-page';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** Takes the WebGL context away, or gives it back. */
async function context(page: Page, change: 'loseContext' | 'restoreContext'): Promise<void> {
  await page.evaluate(change => {
    const canvas = document.querySelector<HTMLCanvasElement>('#picture')!;
    const found = window as unknown as { lose?: WEBGL_lose_context };
    // A lost context gives no extensions.
    found.lose ??= canvas.getContext('webgl2')!.getExtension('WEBGL_lose_context')!;
    const name = change === 'loseContext' ? 'webglcontextlost' : 'webglcontextrestored';
    const done = new Promise(resolve => canvas.addEventListener(name, resolve, { once: true }));
    found.lose[change]();
    return done;
  }, change);
}

/** Waits until the notice is shown or hidden, and returns its text. */
async function notice(page: Page, shown: boolean): Promise<string | null> {
  const has = (shown: boolean) => document.querySelector('#notice')!.classList.contains('shown') === shown;
  await page.waitForFunction(has, shown);
  return page.textContent('#notice');
}

test('a lost WebGL context is reported, and the same picture comes back, also of a tower that sleeps', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=6`);
  const { page } = session;
  await page.waitForFunction(() => window.teeter.awake === 0);
  const middle = [1 / 3, 1 / 4, 1 / 3, 1 / 2];
  const before = await contrast(page, '#picture', middle);
  expect(before).toBeGreaterThan(10);

  await context(page, 'loseContext');
  expect(await notice(page, true)).toBe('The graphics were interrupted. The tower comes back in a moment.');
  // The physics goes on.
  await session.simulate(0.5);

  await context(page, 'restoreContext');
  await notice(page, false);
  await session.settled(() => window.teeter.camera);
  const after = await contrast(page, '#picture', middle);
  expect(Math.abs(after - before), `contrast ${before} before, ${after} after`).toBeLessThan(0.5);
  // The next loss is reported as well.
  await context(page, 'loseContext');
  await notice(page, true);
  await context(page, 'restoreContext');
  await notice(page, false);
  expect(await page.locator('#trouble').isHidden()).toBe(true);
});

test('the museum reports a lost WebGL context, and draws its paused tower again', async () => {
  await using session = await museum.open(chrome, museum.SMALL);
  const { page } = session;
  await museum.simulate(page, 0.3);
  await page.click('#pause');
  const middle = [0.35, 0.3, 0.3, 0.5];
  const before = await contrast(page, '#picture', middle);
  expect(before).toBeGreaterThan(10);
  await context(page, 'loseContext');
  expect(await notice(page, true)).toBe('The graphics were interrupted. The tower comes back in a moment.');
  await context(page, 'restoreContext');
  await notice(page, false);
  await expect.poll(() => contrast(page, '#picture', middle), { timeout: 60_000 }).toBeGreaterThan(0.9 * before);
  expect(await page.locator('#trouble').isHidden()).toBe(true);
});

test('an engine that takes long to load is reported until it has loaded', async () => {
  let load = () => {};
  const held = new Promise<void>(resolve => (load = resolve));
  await using session = await Session.open(chrome, SMALL, {
    ready: false,
    before: page =>
      page.route('**/teeter_wasm_bg-*.wasm', async route => {
        await held;
        await route.continue();
      }),
  });
  const { page } = session;
  expect(await notice(page, true)).toBe('The engine takes long to load.');
  load();
  await page.waitForFunction(() => window.teeter?.ready);
  await notice(page, false);
  expect(session.complaints).toEqual([]);
});
