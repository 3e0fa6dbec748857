// Games with turns in a real browser: by rules, to their end, and after the page was closed.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { host, Session, SMALL, states, type Host } from './browser';
import { load } from '../engine.mjs';
import { drawOut, endOf, phase, takeOut } from './hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** A tower of three rows, in which the blocks 3, 4 and 5 are the row in the middle. */
const LOW = `${SMALL}&rows=3&seed=1`;

test('two players are chosen in the menu and play by pointer until the tower falls', async () => {
  await using session = await Session.open(chrome, LOW);
  const { page } = session;
  await page.click('#menu-open');
  await page.click('[data-mode="hot-seat"]');
  await page.locator('#match-players input').nth(0).fill('Anna');
  await page.locator('#match-players input').nth(1).fill('Ben');
  await session.rebuild(() => page.click('#match-start'));
  await phase(session, 'choosing', 1);
  expect(await page.textContent('#turn-name')).toBe('Anna');

  // A block of the highest row is refused, with the reason.
  const top = await endOf(session, 7);
  await page.mouse.move(top.at.x, top.at.y);
  await page.mouse.down();
  await page.waitForFunction(() => document.getElementById('notice')!.textContent!.startsWith('Too high'));
  await page.mouse.up();
  expect(await page.evaluate(() => window.teeter.hand)).toBeNull();

  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  expect(await page.textContent('#turn-name')).toBe('Ben');
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');

  // Without the block in the middle what is above loses its support.
  await drawOut(session, 4);
  await page.waitForSelector('#end[open]');
  await page.mouse.up();
  expect(await page.textContent('#end-title')).toBe('Anna wins');
  expect(await page.textContent('#end .reason')).toMatch(/^\d+ blocks? fell in the turn of Ben\.$/);
  expect(await page.evaluate(() => window.teeter.turn)).toMatchObject({
    phase: 'over',
    outcome: { loser: 1, winner: 0 },
  });

  // The loser begins the next game.
  await session.rebuild(() => page.click('#end-again'));
  await phase(session, 'choosing', 1);
  expect(await page.textContent('#turn-name')).toBe('Ben');
  expect(session.complaints).toEqual([]);
});

test('a page that is loaded again in mid-game goes on with the same states', async () => {
  await using session = await Session.open(chrome, `${LOW}&mode=hot-seat`);
  const { page } = session;
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  await session.simulate(0.5);
  // A block is held half-way out, and the page is closed.
  const { at, out } = await endOf(session, 0);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move((2 * at.x + out.x) / 3, (2 * at.y + out.y) / 3, { steps: 8 });
  await session.simulate(0.6);
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.teeter.paused);
  const before = await page.evaluate(async () => ({
    ...(await window.teeter.hash()),
    record: await window.teeter.record(),
    turn: window.teeter.turn!,
  }));
  await page.waitForFunction(time => window.teeter.saved === time, before.time);

  await page.reload();
  await page.waitForFunction(() => window.teeter?.ready && window.teeter.paused);
  const after = await page.evaluate(() => ({ hand: window.teeter.hand, turn: window.teeter.turn }));
  expect(after.hand, 'the block is still in the hand').toMatchObject({ body: 0 });
  expect(after.turn).toMatchObject({ number: 2, player: 1, phase: before.turn.phase });
  const found = states(session, before.time + 1);
  await page.keyboard.press(' ');
  const resumed = await found;
  const game = (await load('simd128')).Game.resume(Uint8Array.from(before.record));
  expect(game.hash()).toBe(before.hash);
  const expected = new Map<string, string>();
  while (game.time() < before.time + 1) {
    game.step('');
    expected.set(game.time().toFixed(4), game.hash());
  }
  expect(resumed.size).toBeGreaterThan(30);
  expect([...resumed.entries()].filter(([time, hash]) => expected.get(time) !== hash)).toEqual([]);
  expect(session.complaints).toEqual([]);
});
