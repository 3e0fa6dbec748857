// Records in a real browser: a link opens the same move, bit for bit, and a forged one is refused.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { load } from '../engine.mjs';
import { drop, host, Session, SMALL, type Host } from './browser';
import { forged } from './forgery';
import { phase, takeOut } from './hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

const LOW = `${SMALL}&rows=3&seed=1`;

/** Goes to shortly before the end of a replay, and waits for it. */
async function scrubToEnd({ page }: Session): Promise<void> {
  const frames = await page.evaluate(() => window.teeter.replay!.frames);
  await page.locator('#replay-scrub').fill(String(frames - 20));
  await page.waitForFunction(() => window.teeter.replay?.frame === window.teeter.replay?.frames);
}

test('a link holds the last pull, and plays it in another profile with the same bits', async () => {
  let link = '';
  {
    await using session = await Session.open(chrome, `${LOW}&mode=hot-seat`, {
      permissions: ['clipboard-read', 'clipboard-write'],
    });
    const { page } = session;
    await page.click('#menu-open');
    await page.click('#menu-share');
    await page.waitForFunction(() => document.getElementById('notice')!.textContent!.startsWith('There is no pull'));
    await takeOut(session, 3);
    await phase(session, 'choosing', 2);
    await page.click('#menu-open');
    await page.click('#menu-share');
    await page.waitForFunction(() => document.getElementById('notice')!.textContent!.startsWith('The link is copied'));
    link = await page.evaluate(() => navigator.clipboard.readText());
    expect(session.complaints).toEqual([]);
  }
  expect(link.length, 'bytes of the link').toBeLessThan(2048);

  const bytes = Buffer.from(link.split('#move=')[1], 'base64url');
  const { Replay } = await load('simd128');
  const replay = new Replay(bytes);
  while (replay.step() !== undefined);
  expect(replay.isSame).toBe(true);

  await using session = await Session.open(chrome, `${SMALL}${new URL(link).hash}`);
  const { page } = session;
  await page.waitForFunction(() => window.teeter.replay !== null);
  expect(await page.evaluate(() => window.teeter.count)).toBe(9);
  await scrubToEnd(session);
  const end = await page.evaluate(async () => ({ ...(await window.teeter.hash()), same: window.teeter.replay!.same }));
  expect(end).toMatchObject({ hash: replay.hash(), same: true });

  // Back in time, and forward again: the same state.
  await page.locator('#replay-scrub').fill('20');
  await page.waitForFunction(() => window.teeter.replay!.frame < 200);
  await scrubToEnd(session);
  expect((await page.evaluate(() => window.teeter.hash())).hash).toBe(replay.hash());

  // The challenge begins on the tower before the pull.
  await session.rebuild(() => page.click('#replay-challenge'));
  await phase(session, 'choosing', 1);
  // The line is written four times a second.
  await page.waitForFunction(() => /^Beat this pull: \d+\.\d s$/.test(document.getElementById('state')!.textContent!));
  expect(page.url()).not.toContain('#move');
  expect(session.complaints).toEqual([]);
});

test('a record that was changed is refused, with the reason, and so is a file that is none', async () => {
  await using session = await Session.open(chrome, `${LOW}&mode=hot-seat`);
  const { page } = session;
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  const record = await page.evaluate(() => window.teeter.record());
  const world = await page.evaluate(() => window.teeter.world);
  await drop(session, [...(await forged(Uint8Array.from(record)))]);
  await page.waitForFunction(() => document.getElementById('notice')!.textContent!.startsWith('Refused: this record'));
  await drop(session, record.slice(0, 100));
  await page.waitForFunction(() => /truncated/.test(document.getElementById('notice')!.textContent!));
  await drop(session, [1, 2, 3]);
  await page.waitForFunction(() => /no record/.test(document.getElementById('notice')!.textContent!));
  expect(await page.evaluate(() => window.teeter.world), 'the game goes on').toBe(world);
  expect(await page.isHidden('#replay')).toBe(true);

  // The true one is played, and the game goes on after it.
  const before = await page.evaluate(() => window.teeter.hash());
  await drop(session, record);
  await page.waitForSelector('#replay:not([hidden])');
  await session.rebuild(() => page.click('#replay-close'));
  await phase(session, 'choosing', 2);
  expect((await page.evaluate(() => window.teeter.hash())).time).toBeGreaterThanOrEqual(before.time);
  expect(session.complaints).toEqual([]);
});
