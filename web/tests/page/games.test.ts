// Games with turns in a real browser: by rules, to their end, and after the page was closed.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { host, Session, SMALL, states, type Host } from './browser';
import { load } from '../engine.mjs';
import { drawOut, endOf, lead, phase, takeOut } from './hands';

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

test('the computer thinks beside the page and moves in its turn, and the game goes on', async () => {
  await using session = await Session.open(chrome, `${LOW}&mode=opponent`);
  const { page } = session;
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  const turned = await page.evaluate(() => window.teeter.camera.azimuth);
  // While it is at its turn a press on a block turns the camera.
  const { at } = await endOf(session, 0);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 60, at.y, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(azimuth => window.teeter.camera.azimuth !== azimuth, turned);
  const next = () => window.teeter.turn?.phase === 'over' || window.teeter.turn?.number === 3;
  await page.waitForFunction(next, undefined, { timeout: 400_000 });
  const { turn, record } = await page.evaluate(async () => ({
    turn: window.teeter.turn!,
    record: await window.teeter.record(),
  }));
  expect(turn.outcome?.loser === 1 || turn.player === 0).toBe(true);
  // Its commands are part of the record.
  const { Replay } = await load('simd128');
  const replay = new Replay(Uint8Array.from(record));
  let moved = 0;
  for (let update; (update = replay.step()) !== undefined;) {
    const { events } = JSON.parse(update) as { events: { event: string; player?: number }[] };
    moved += events.filter(({ event, player }) => event === 'removed' && player === 1).length;
  }
  expect(replay.isSame).toBe(true);
  expect(moved + (turn.outcome ? 1 : 0)).toBeGreaterThan(0);
  expect(session.complaints).toEqual([]);
});

test('practice takes turns back to the same state, even after a fall', async () => {
  await using session = await Session.open(chrome, `${LOW}&mode=practice`);
  const { page } = session;
  const hash = async () => (await page.evaluate(() => window.teeter.hash())).hash;
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  await drawOut(session, 4);
  await page.waitForSelector('#end[open]');
  await page.mouse.up();
  await page.click('#end-view');
  await page.waitForFunction(() => window.teeter.turn?.phase === 'over');
  await session.rebuild(() => page.click('#undo'));
  await phase(session, 'choosing', 2);
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
  await session.rebuild(() => page.click('#undo'));
  expect(await page.evaluate(() => window.teeter.turn)).toMatchObject({ number: 1, phase: 'choosing' });
  // The button ends, and with it what the keys go to.
  await page.waitForFunction(() => document.querySelector<HTMLButtonElement>('#undo')!.disabled);
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.teeter.paused);
  expect(await hash()).toMatch(/^[0-9a-f]{16}$/);
  expect(session.complaints).toEqual([]);
});

test('by touch on a phone a block is drawn out and put on top, and the tower is felled', async () => {
  await using session = await Session.open(chrome, `${LOW}&mode=hot-seat`, {
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  const { page } = session;
  const touch = await page.context().newCDPSession(page);
  const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: { x: number; y: number }[]) =>
    touch.send('Input.dispatchTouchEvent', { type, touchPoints });
  const pull = async (body: number) => {
    const { at, out } = await endOf(session, body);
    await send('touchStart', [at]);
    for (let k = 1; k <= 40; k++) {
      await send('touchMove', [{ x: at.x + ((out.x - at.x) * k) / 40, y: at.y + ((out.y - at.y) * k) / 40 }]);
      await session.simulate(0.03);
    }
    return out;
  };
  await session.simulate(0.5);
  const out = await pull(3);
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  // The finger carries the block to a ghost, and lets go.
  const path = await page.evaluate(() => {
    const here = window.teeter.screenOf(window.teeter.hand!.body);
    const there = window.teeter.project(window.teeter.slots[1] as [number, number, number]);
    return { x: there.x - here.x, y: there.y - here.y };
  });
  for (let k = 1; k <= 40; k++) {
    await send('touchMove', [{ x: out.x + (path.x * k) / 40, y: out.y + (path.y * k) / 40 }]);
    await session.simulate(0.03);
  }
  await page.waitForFunction(() => window.teeter.hand?.slot);
  await send('touchEnd', []);
  await phase(session, 'choosing', 2);
  expect(await page.textContent('#turn-name')).toBe('Player 2');
  await pull(4);
  await page.waitForSelector('#end[open]');
  await send('touchEnd', []);
  expect(await page.textContent('#end-title')).toBe('Player 1 wins');
  expect(session.complaints).toEqual([]);
});

test('a game of two is played to its end with keys alone', async () => {
  await using session = await Session.open(chrome, LOW);
  const { page } = session;
  // From the menu to the first turn.
  await page.keyboard.press('g');
  await page.waitForSelector('#menu[open]');
  await page.locator('[data-mode="hot-seat"]').focus();
  await page.keyboard.press('Enter');
  await page.locator('#match-players input').nth(0).focus();
  await page.keyboard.type('Anna');
  await session.rebuild(() => page.keyboard.press('Enter'));
  await phase(session, 'choosing', 1);

  const takeByKeys = async (body: number) => {
    await page.keyboard.press('Enter');
    await lead(page, body, direction => page.keyboard.press(`Arrow${direction}`));
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => window.teeter.hand !== null);
    await page.keyboard.down('ArrowDown');
  };
  await takeByKeys(3);
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  await page.keyboard.up('ArrowDown');
  await page.waitForFunction(() => !(document.getElementById('place') as HTMLButtonElement).disabled);
  await page.keyboard.press('Enter');
  await phase(session, 'choosing', 2);
  await page.keyboard.press('Escape');
  await takeByKeys(4);
  await page.waitForSelector('#end[open]');
  await page.keyboard.up('ArrowDown');
  expect(await page.textContent('#end-title')).toBe('Anna wins');
  // The button of the next game has the focus.
  await session.rebuild(() => page.keyboard.press('Enter'));
  await phase(session, 'choosing', 1);
  expect(session.complaints).toEqual([]);
});
