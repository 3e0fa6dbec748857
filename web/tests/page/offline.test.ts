// The page without a network, and a new version of it.

import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { gzipSync } from 'node:zlib';
import { afterAll, beforeAll, expect, onTestFinished, test } from 'vitest';
import { COMPRESSED } from '../../compressed-files';
import { ENGINES } from '../../kept-engines';
import { host, ROOT, Session, SMALL, type Host } from './browser';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

test('after one visit the game and the museum start without a network', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`, { offline: true });
  const { page } = session;
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await page.context().setOffline(true);
  await page.goto(`${chrome.address}?${SMALL}&rows=4&render=once`);
  await page.waitForFunction(() => window.teeter?.ready && window.teeter.count === 12);
  await session.simulate(0.2);
  await page.goto(`${chrome.address}museum.html?quality=low&scale=0.2&rows=3`);
  await page.waitForFunction(() => window.museum?.tower?.ready);
  expect(session.complaints).toEqual([]);
});

test('a new version is offered in the settings, not in mid-game, and loaded when it is asked for', async () => {
  const root = mkdtempSync(`${tmpdir()}/teeter-page-`);
  cpSync(`${ROOT}/dist`, `${root}/dist`, { recursive: true });
  const other = await host(root);
  onTestFinished(async () => {
    await other.stop();
    rmSync(root, { recursive: true });
  });
  await using session = await Session.open(other, `${SMALL}&rows=3&render=once`, { offline: true });
  const { page } = session;
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  const worker = `${root}/dist/service-worker.js`;
  writeFileSync(worker, readFileSync(worker, 'utf8').replace(/teeter-[0-9a-f]{16}/, 'teeter-next'));
  await page.evaluate(async () => {
    await (await navigator.serviceWorker.getRegistration())!.update();
  });
  await page.waitForSelector('#new-version:not([hidden])', { state: 'attached' });
  const notice = () => page.textContent('#notice.shown').catch(() => null);
  expect(await page.locator('#notice.shown').count(), 'announced in mid-game').toBe(0);
  await session.rebuild(() => page.click('#reset'));
  expect(await notice()).toContain('new version');
  await page.click('#settings');
  await Promise.all([page.waitForNavigation(), page.click('#new-version')]);
  await page.waitForFunction(() => window.teeter?.ready);
  expect(await page.evaluate(() => caches.keys())).toEqual(['teeter-next']);
});

test('all files are below 1.5 MB compressed, and none above 512 kB', () => {
  const entries = readdirSync(`${ROOT}/dist`, { recursive: true, withFileTypes: true }).filter(entry => entry.isFile());
  const paths = new Set(entries.map(entry => `${entry.parentPath}/${entry.name}`));
  const files = [...paths]
    .filter(path => !path.endsWith(COMPRESSED))
    .map(path => ({
      path,
      gzip: gzipSync(readFileSync(path)).length,
      best: statSync(paths.has(path + COMPRESSED) ? path + COMPRESSED : path).size,
    }));
  expect(files.length).toBeGreaterThan(10);
  expect(files.filter(({ best }) => best > 512_000)).toEqual([]);
  // All of it, the museum and the pictures included, for browsers that take gzip alone. Kept
  // engines are fetched one by one, where a record needs one.
  const page = files.filter(({ path }) => !path.startsWith(`${ROOT}/dist/${ENGINES}`));
  expect(
    page.reduce((total, { gzip }) => total + gzip, 0),
    'bytes',
  ).toBeLessThan(1_500_000);
});
