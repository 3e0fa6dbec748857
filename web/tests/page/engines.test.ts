// Records and their engines in a real browser: each is replayed by the engine that wrote it, which
// is fetched only where a record needs it, and shown by its keyframes where that is missing.

import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { bytes, load } from '../engine.mjs';
import { drop, host, ROOT, Session, SMALL, type Host } from './browser';
import { forged, renamed } from './forgery';

const PAGE = `${SMALL}&rows=3&render=once`;
const FRAMES = 120;

let chrome: Host, root: string;
/** A pile that falls, by this engine, by a kept one and by one that is missing. */
let own: Uint8Array, kept: Uint8Array, missing: Uint8Array;
/** Hash of the state at its end. */
let hash: string;
let engine: Awaited<ReturnType<typeof load>>;

beforeAll(async () => {
  engine = await load('simd128');
  const game = new engine.Game(engine.namedScene('pile'), JSON.stringify({ sleep: true, frame: 1 / 60 }), '');
  game.startRecord();
  for (let frame = 0; frame < FRAMES; frame++) game.step('');
  own = game.record(false)!;
  hash = game.hash();
  const [version, bits] = engine.engineId().split('+');
  kept = await renamed(own, `${version}+${'5'.repeat(bits.length)}`);
  missing = await renamed(own, `${version}+${'6'.repeat(bits.length)}`);

  root = mkdtempSync(`${tmpdir()}/teeter-engines-`);
  cpSync(`${ROOT}/dist`, `${root}/dist`, { recursive: true });
  const folder = `${root}/dist/engines/${version}-${'5'.repeat(bits.length)}`;
  mkdirSync(folder, { recursive: true });
  cpSync(`${ROOT}/src/wasm/teeter_wasm.js`, `${folder}/teeter_wasm.js`);
  // This engine under another name, which is text in its module.
  const module = Buffer.from(await bytes('simd128'));
  let found = 0;
  for (let at = module.indexOf(bits); at >= 0; at = module.indexOf(bits, at + 1), found++)
    module.write('5'.repeat(bits.length), at, 'latin1');
  expect(found, 'the name is in the module').toBeGreaterThan(0);
  writeFileSync(`${folder}/teeter_wasm_bg.wasm`, module);
  chrome = await host(root);
}, 600_000);
afterAll(async () => {
  await chrome?.stop();
  rmSync(root, { recursive: true });
});

/** Opens a record, plays it to its end, and returns the state there and the lines shown so far. */
async function toEnd(session: Session, record: Uint8Array) {
  const { page } = session;
  await page.evaluate(() => {
    const lines: string[] = [];
    const note = document.getElementById('notice')!;
    new MutationObserver(() => lines.push(note.textContent!)).observe(note, { childList: true });
    Object.assign(window, { lines });
  });
  await session.rebuild(() => drop(session, record));
  await page.waitForFunction(() => window.teeter.replay?.frame === window.teeter.replay?.frames);
  return page.evaluate(async () => ({
    state: { ...window.teeter.replay!, hash: (await window.teeter.hash()).hash },
    said: (window as unknown as { lines: string[] }).lines.join('\n'),
  }));
}

test('a record of this engine is replayed by it, and no other is fetched', async () => {
  await using session = await Session.open(chrome, PAGE);
  const fetched: string[] = [];
  session.page.on('request', request => fetched.push(request.url()));
  const { state, said } = await toEnd(session, own);
  expect(state).toEqual({ frame: FRAMES, frames: FRAMES, engine: 'own', same: true, hash });
  expect(said).toContain('Checked: the record is true');
  expect(fetched.filter(url => url.includes('/engines/'))).toEqual([]);
  expect(session.complaints).toEqual([]);
});

test('a record of a kept engine is checked and replayed by it, later without a network as well', async () => {
  await using session = await Session.open(chrome, PAGE, { offline: true });
  const { page } = session;
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  const stored = () => page.evaluate(() => caches.keys());
  expect(await stored(), 'nothing is fetched before it is needed').not.toContain('engines');
  const { state, said } = await toEnd(session, kept);
  expect(state).toEqual({ frame: FRAMES, frames: FRAMES, engine: 'kept', same: true, hash });
  expect(said).toContain('Checked: the record is true');
  expect(await page.isHidden('#replay-note')).toBe(true);
  expect(await stored()).toContain('engines');

  await page.context().setOffline(true);
  await page.goto(`${chrome.address}?${PAGE}`);
  await page.waitForFunction(() => window.teeter?.ready);
  expect((await toEnd(session, kept)).state).toMatchObject({ engine: 'kept', same: true, hash });
  expect(session.complaints).toEqual([]);
});

test('where the engine is missing the keyframes play, and the page says that nothing is checked', async () => {
  await using session = await Session.open(chrome, PAGE);
  const { page } = session;
  const { state, said } = await toEnd(session, missing);
  expect(state).toMatchObject({ frame: FRAMES, frames: FRAMES, engine: 'missing', same: null });
  expect(said).toMatch(/^Unchecked: .*6666666666666666.* missing/m);
  expect(await page.textContent('#replay-note')).toContain('Unchecked');
  const keyframes = new engine.Keyframes(missing);
  const [end, middle] = [keyframes.poses(FRAMES / 60), keyframes.poses(0.5)];
  expect(await session.poses()).toEqual([...Float32Array.from(end)]);
  await page.locator('#replay-scrub').fill('30');
  await page.click('#replay-toggle');
  await page.waitForFunction(() => window.teeter.paused);
  await page.locator('#replay-scrub').fill('30');
  await page.waitForFunction(() => window.teeter.replay!.frame === 30);
  expect(await session.poses()).toEqual([...Float32Array.from(middle)]);
  expect(session.complaints).toEqual([]);
});

test('a forged record of a kept engine is refused', async () => {
  await using session = await Session.open(chrome, PAGE);
  const tower = new engine.Game(engine.towerScene('{"rows": 3}'), '', '');
  tower.startRecord();
  for (let frame = 0; frame < FRAMES; frame++) tower.step('');
  const record = await forged(tower.record(false)!);
  await drop(session, await renamed(record, engine.recordEngine(kept)));
  await session.page.waitForFunction(() => document.getElementById('notice')!.textContent!.startsWith('Refused'));
  expect(await session.page.evaluate(() => window.teeter.replay)).toBeNull();
});
