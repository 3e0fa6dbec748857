// The tower of the day in a real browser: games of others that are true are ranked beside that of
// the player, the best one is the ghost, and a forged one is refused.

import { afterAll, beforeAll, expect, test } from 'vitest';
import type { Page } from 'playwright-core';
import type { Game } from '../../src/engine/game';
import type { GameCommand, Update } from '../../src/engine/game-protocol';
import load from '../../src/wasm/teeter_wasm.js';
import { bytes } from '../engine.mjs';
import { drop, host, Session, SMALL, type Host } from './browser';
import { beginDaily } from './daily-game';
import { forged } from './forgery';
import { phase, takeOut } from './hands';

const DAY = '2026-03-09';
/** Blocks of the tower of that day that come out easily, in rows along the x axis. */
const LOOSE = [6, 31];

interface Shared {
  record: Uint8Array;
  points: number;
  /** Poses when the tower stood last. */
  poses: number[];
}

let chrome: Host;
let short: Shared, long: Shared;
beforeAll(async () => {
  const { memory } = await load({ module_or_path: await bytes('simd128') });
  short = playedGame(1, memory);
  long = playedGame(2, memory);
  chrome = await host();
}, 600_000);
afterAll(() => chrome?.stop());

/** A game on the tower of the day in which so many blocks are put on top. */
function playedGame(turns: number, memory: WebAssembly.Memory): Shared {
  const game = beginDaily(DAY, memory);
  let update = game.step({ command: 'idle' });
  let poses = game.poses();
  const play = (command: GameCommand): Update => {
    update = game.step(command);
    if (update.events.some(({ event }) => event === 'settled')) poses = game.poses();
    return update;
  };
  for (const body of LOOSE.slice(0, turns)) pullOut(game, body, play);
  expect(update.turn).toMatchObject({ phase: 'choosing', number: turns + 1 });
  const record = game.record(false)!.bytes;
  game.free();
  return { record, points: update.turn!.scores[0], poses: [...poses] };
}

/** Pulls a block out along its length and has it put on top. */
function pullOut(game: Game, body: number, play: (command: GameCommand) => Update): void {
  const half = game.sizes()[3 * body] / 2;
  play({ command: 'grasp', body, anchor: [half, 0, 0], normal: [1, 0, 0], grip: 'auto' });
  for (let frame = 0; frame < 120; frame++)
    if (play({ command: 'move', displacement: [0.0015, 0, 0], slot: null, toward_viewer: null }).hand?.grip === 'carry')
      break;
  play({ command: 'place', body: null, slot: null });
  const { number } = play({ command: 'idle' }).turn!;
  for (let frame = 0; frame < 900; frame++) {
    const turn = play({ command: 'idle' }).turn!;
    if (turn.number > number || turn.phase === 'over') break;
  }
}

const before = (page: Page) => page.clock.setSystemTime(`${DAY}T12:00:00Z`);
const daily = (options = {}) => Session.open(chrome, `${SMALL}&mode=daily&render=once`, { before, ...options });
const said = ({ page }: Session, text: string) =>
  page.waitForFunction(text => document.getElementById('notice')!.textContent!.includes(text), text);
const ghost = ({ page }: Session) => page.evaluate(() => window.teeter.ghost);

/** Opens the game of somebody else as a file, and ranks it by the name that is proposed. */
async function rank(session: Session, record: Uint8Array, file: string): Promise<void> {
  await drop(session, record, file);
  await session.page.waitForSelector('#rank[open]');
  await session.page.click('#rank-it');
}

test('true games of others are ranked, the best is the ghost, and a forged one is refused', async () => {
  await using session = await daily();
  const { page } = session;
  await said(session, 'The first game on this tower');
  expect(await ghost(session)).toBeNull();

  await rank(session, short.record, 'Anna.record');
  await said(session, 'Anna is number 1 of 1 today');
  await page.waitForFunction(() => window.teeter.ghost !== null);
  expect(await ghost(session)).toEqual(short.poses);
  expect(await page.evaluate(() => window.teeter.replay), 'the game goes on').toBeNull();

  // A better record becomes the ghost, and stays it in the next game.
  await rank(session, long.record, 'Ben.record');
  await said(session, 'Ben is number 1 of 2 today');
  await page.waitForFunction(length => window.teeter.ghost!.length === length, long.poses.length);
  expect(await ghost(session)).toEqual(long.poses);
  await session.rebuild(() => page.click('#reset'));
  await said(session, `Best today: Ben, ${long.points} points`);
  expect(await ghost(session)).toEqual(long.poses);

  // The same record again has the same rank, and a forged one none.
  await rank(session, short.record, 'Carl.record');
  await said(session, 'number 2 of 2 today');
  await drop(session, await forged(long.record), 'Mallory.record');
  await said(session, 'Refused: this record is forged. From');
  expect(await page.locator('#rank[open]').count()).toBe(0);

  await page.reload();
  await page.waitForFunction(() => window.teeter?.ready);
  await page.click('#menu-open');
  await page.click('[data-mode="daily"]');
  await page.waitForFunction(() => document.querySelectorAll('.ranking li').length === 2);
  const rows = await page.locator('.ranking li').allTextContents();
  expect(rows[0]).toMatch(new RegExp(`^1\\.Ben ✓${long.points} points, \\d+ mm$`));
  expect(rows[1]).toMatch(/^2\.Anna ✓\d point/);
  await session.rebuild(() => page.locator('.ranking button').nth(0).click());
  await page.waitForFunction(() => window.teeter.replay !== null);
  expect(session.complaints).toEqual([]);
});

test('the best game of the player is ranked at its end, and is the ghost of the next', async () => {
  await using session = await daily();
  const { page } = session;
  await takeOut(session, LOOSE[0]);
  await phase(session, 'choosing', 2);
  const poses = await session.poses();
  await page.click('#menu-open');
  await page.click('#menu-resign');
  await page.waitForSelector('#end[open] .ranking .own');
  expect(await page.textContent('.ranking .own .name')).toBe('You');
  await session.rebuild(() => page.click('#end-again'));
  await said(session, 'Your best: 1 point');
  const shown = (await ghost(session))!;
  expect(Math.max(...shown.map((x, i) => Math.abs(x - poses[i]))), 'as the tower stood').toBeLessThan(0.002);
  expect(session.complaints).toEqual([]);
});
