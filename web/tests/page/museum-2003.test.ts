// The hand of 2003 and its constants in the museum: both drags by real pointers, the hold during a
// pause, the switches, and the scenes of the dissertation.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { displacements, drag, host, type Host, type Session } from './browser';
import { facing, open, simulate, SMALL, tower } from './museum-page';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

type Point = { x: number; y: number };

/** Opens the tower of 2003 with its own hand, at rest. */
async function openHand(options: Parameters<typeof open>[2] = {}): Promise<Session> {
  const session = await open(chrome, SMALL, options);
  await session.page.locator('input[name="hand-of"][value="old"]').check({ force: true });
  await simulate(session.page, 0.4);
  return session;
}

const held = (page: Page) => page.evaluate(() => window.museum.tower!.of2003.hand);

/** Waits until the hand of 2003 holds a block, or none. */
async function waitForHold(page: Page, holds: boolean): Promise<void> {
  await page.waitForFunction(expected => (window.museum.tower!.of2003.hand !== null) === expected, holds);
}

/** Displacement of a block between two arrays of poses, m: towards the viewer, and across. */
async function along(page: Page, body: number, before: number[], after: number[]) {
  const camera = await page.evaluate(() => window.museum.tower!.towardViewer);
  const by = [0, 1, 2].map(k => after[7 * body + k] - before[7 * body + k]);
  const depth = by.reduce((sum, d, k) => sum + d * camera[k], 0);
  return { depth, across: Math.hypot(...by.map((d, k) => d - depth * camera[k])) };
}

/** Turns the camera so that it views almost level along -x, onto the ends of every other row. */
async function viewAlongX(session: Session): Promise<void> {
  const { page } = session;
  const box = (await page.locator('#picture').boundingBox())!;
  const from = { x: box.x + box.width - 12, y: box.y + 90 };
  const azimuth = await page.evaluate(() => {
    const [x, y] = window.museum.tower!.towardViewer;
    return Math.atan2(y, x);
  });
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // Radians per pixel of the orbit.
  await drag(session, from, { x: from.x + azimuth / 0.007, y: from.y - 0.28 / 0.006 }, 4);
  await page.mouse.up();
  await session.settled(() => window.museum.tower!.camera);
}

/** Pixels on the screen of a length (m) at a block, seen almost level. */
async function pixels(page: Page, body: number, length: number): Promise<number> {
  const [low, high] = await page.evaluate(b => {
    const t = window.museum.tower!;
    return [-0.009, 0.009].map(z => t.screenOf(b, [0, 0, z]).y);
  }, body);
  return (length / 0.018) * Math.abs(high - low);
}

/** A free block of the top row, and its position on the page. */
async function topBlock(page: Page): Promise<{ body: number; at: Point }> {
  const { x, y } = (await page.locator('#picture').boundingBox())!;
  const found = await page.evaluate(() => {
    const t = window.museum.tower!;
    for (let body = t.count - 1; body >= t.count - 3; body--) {
      const at = t.screenOf(body, [0, 0, t.sizes[3 * body + 2] / 2]);
      if (t.blockAt(at.x, at.y) === body) return { body, at };
    }
    return null;
  });
  return { body: found!.body, at: { x: x + found!.at.x, y: y + found!.at.y } };
}

test('the left button drags a block in the plane of the screen', async () => {
  await using session = await openHand();
  const { page } = session;
  const { body, at } = await topBlock(page);
  const before = await tower(page);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await waitForHold(page, true);
  expect((await held(page))!.body).toBe(body);
  await drag(session, at, { x: at.x + 60, y: at.y - 60 }, 12, 0.03);
  await simulate(page, 0.5);
  const lifted = await tower(page);
  const { depth, across } = await along(page, body, before.poses, lifted.poses);
  expect(across, 'in the plane, m').toBeGreaterThan(0.03);
  expect(Math.abs(depth), 'in depth, m').toBeLessThan(0.2 * across);
  expect(lifted.poses[7 * body + 2], 'it hangs in the air, m').toBeGreaterThan(before.poses[7 * body + 2] + 0.015);
  expect((await held(page))!.force, 'in the air the velocity is written').toBeNull();
  await page.mouse.up();
  await waitForHold(page, false);
  expect(session.complaints).toEqual([]);
});

test('a flick with the right button draws a block towards the viewer at 2 m/s and more', async () => {
  await using session = await openHand();
  const { page } = session;
  await viewAlongX(session);
  const { body, at } = (await facing(page))!;
  const before = await tower(page);
  expect(await page.evaluate(() => window.museum.tower!.of2003.maxSpeed), 'as it settles, m/s').toBeLessThan(0.3);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down({ button: 'right' });
  await waitForHold(page, true);
  // Downwards on the screen is towards the viewer, without a limit of speed.
  await drag(session, at, { x: at.x, y: at.y + (await pixels(page, body, 0.15)) }, 2);
  await simulate(page, 0.4);
  await page.mouse.up({ button: 'right' });
  const { depth, across } = await along(page, body, before.poses, (await tower(page)).poses);
  expect(depth, 'towards the viewer, m').toBeGreaterThan(0.081);
  expect(across, 'it may tip as it comes out, m').toBeLessThan(depth);
  expect(await page.evaluate(() => window.museum.tower!.of2003.maxSpeed), 'm/s').toBeGreaterThan(2);
  expect(session.complaints).toEqual([]);
});

test('on touch a second finger pulls in depth', async () => {
  await using session = await openHand({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const { page } = session;
  await page.locator('#picture').scrollIntoViewIfNeeded();
  await viewAlongX(session);
  const { body, at } = (await facing(page))!;
  const touches = await page.context().newCDPSession(page);
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: Point[]) =>
    touches.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: points.map(({ x, y }, id) => ({ x, y, id })),
    });
  const before = await tower(page);
  await touch('touchStart', at);
  await waitForHold(page, true);
  expect((await held(page))!.body).toBe(body);
  const beside = (by: number): [Point, Point] => [
    { x: at.x, y: at.y + by },
    { x: at.x + 40, y: at.y + by },
  ];
  await touch('touchStart', ...beside(0));
  const path = await pixels(page, body, 0.06);
  for (let part = 1; part <= 12; part++) {
    await touch('touchMove', ...beside((path * part) / 12));
    await simulate(page, 0.02);
  }
  await simulate(page, 0.4);
  const { depth, across } = await along(page, body, before.poses, (await tower(page)).poses);
  expect(depth, 'towards the viewer, m').toBeGreaterThan(0.04);
  expect(across, 'it may tip as it comes out, m').toBeLessThan(depth);
  await touch('touchEnd');
  await waitForHold(page, false);
  expect(session.complaints).toEqual([]);
});

test('a block stays in the hand during a pause, while the camera turns', async () => {
  await using session = await openHand();
  const { page } = session;
  const { body, at } = await topBlock(page);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await waitForHold(page, true);
  await drag(session, at, { x: at.x, y: at.y - 50 }, 10, 0.03);
  await simulate(page, 0.4);
  await page.keyboard.press(' ');
  expect(await page.getAttribute('#pause', 'aria-pressed')).toBe('true');
  await session.settled(() => window.museum.tower!.time);
  const paused = await tower(page);
  const camera = await page.evaluate(() => window.museum.tower!.camera);
  await page.mouse.up();
  await page.mouse.move(at.x - 200, at.y);
  await page.mouse.down();
  await drag(session, { x: at.x - 200, y: at.y }, { x: at.x - 100, y: at.y }, 5);
  await page.mouse.up();
  await session.settled(() => window.museum.tower!.camera);
  const turned = await page.evaluate(() => window.museum.tower!.camera);
  expect(Math.hypot(...turned.map((x, k) => x - camera[k])), 'the camera turned, m').toBeGreaterThan(0.1);
  expect((await held(page))!.body, 'and the block is still in the hand').toBe(body);
  await page.keyboard.press(' ');
  await simulate(page, 0.5);
  const after = await tower(page);
  expect((await held(page))!.body).toBe(body);
  expect(displacements(paused.poses, after.poses)[body], 'it hangs where it was, m').toBeLessThan(0.005);
  // Any press goes on with it, and its end lets go.
  await page.mouse.move(at.x, at.y - 50);
  await page.mouse.down();
  await drag(session, { x: at.x, y: at.y - 50 }, { x: at.x + 60, y: at.y - 50 }, 10, 0.03);
  await simulate(page, 0.4);
  expect(displacements(after.poses, (await tower(page)).poses)[body], 'm').toBeGreaterThan(0.01);
  await page.mouse.up();
  await waitForHold(page, false);
  expect(session.complaints).toEqual([]);
});

test('force, velocity and hybrid are chosen for the hand', async () => {
  await using session = await openHand();
  const { page } = session;
  const { at } = await topBlock(page);
  const force = async (method: string) => {
    await page.selectOption('[data-constant="hand"]', method);
    await page.waitForFunction(m => (window.museum.tower!.of2003.constants.hand ?? 'hybrid') === m, method);
    await simulate(page, 0.1);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await waitForHold(page, true);
    await simulate(page, 0.1);
    const hand = await held(page);
    await page.mouse.up();
    await waitForHold(page, false);
    return hand!.force;
  };
  expect(await force('velocity')).toBeNull();
  expect(await force('force')).not.toBeNull();
  expect(session.complaints).toEqual([]);
});

test('constants act on the standing tower, and what is not accepted is explained', async () => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  await simulate(page, 0.5);
  await page.waitForFunction(() => window.museum.tower!.of2003.disabled.length > 0);
  const { world } = await page.evaluate(() => ({ world: window.museum.tower!.world }));
  await page.selectOption('[data-constant="disabling"]', 'off');
  await page.waitForFunction(() => window.museum.tower!.of2003.disabled.length === 0);
  await page.selectOption('[data-constant="disabling"]', 'rigid-motion');
  await page.locator('[data-constant="static_friction"]').check();
  await page.waitForFunction(() => window.museum.tower!.of2003.disabled.length === 18);
  for (const [name, value] of Object.entries({ method: 'rk4', order: 'top-down', culling: 'boxes' }))
    await page.selectOption(`[data-constant="${name}"]`, value);
  await page.locator('[data-constant="friction_enabled"]').uncheck();
  await page.waitForFunction(() => window.museum.tower!.of2003.constants.friction_enabled === 'false');
  await simulate(page, 0.1);
  await page.click('#constants summary');
  const stiffness = page.locator('[data-constant="stiffness"]');
  for (const [value, reason] of [
    ['1e9', /^`stiffness` is 1e9, expected at most [\d.]+/],
    ['soft', /^`stiffness` is `soft`, expected a number from 1 to 1e9/],
  ] as const) {
    await stiffness.fill(value);
    await stiffness.blur();
    await page.waitForFunction(() => document.getElementById('constants-problem')!.textContent !== '');
    expect(await page.textContent('#constants-problem')).toMatch(reason);
    expect(await stiffness.inputValue(), 'the tower keeps its own').toBe('10000');
  }
  await page.click('#constants-default');
  await page.waitForFunction(() => window.museum.tower!.of2003.constants.disabling === 'listed');
  expect(await page.textContent('#constants-problem')).toBe('');
  expect(await page.evaluate(() => window.museum.tower!.world), 'the same tower all the time').toBe(world);
  expect(session.complaints).toEqual([]);
});

test.each([
  ['test-1', 6, true],
  ['test-2-taken', 2, false],
  ['test-3', 4, false],
  ['test-4', 3, false],
  ['test-5', 4, true],
  ['test-6', 6, true],
  ['moves', 18, true],
])('%s of the dissertation has %i blocks; it stands: %s', async (name, count, stands) => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  await session.rebuild(() => page.selectOption('#scene', name));
  expect((await tower(page)).count).toBe(count);
  const fallen = () => page.evaluate(() => window.museum.tower!.fallen);
  // Some blocks are disabled while they should tip, and take their time.
  for (let seconds = 0; seconds < 5 && !(await fallen()); seconds += 0.5) await simulate(page, 0.5);
  expect(await fallen()).toBe(!stands);
  expect(session.complaints).toEqual([]);
});

test('pointers turn the camera around all sides of the tower (requirement 1.4)', async () => {
  await using session = await open(chrome, `${SMALL}&show=engine`);
  const { page } = session;
  const box = (await page.locator('#picture').boundingBox())!;
  const from = { x: box.x + 20, y: box.y + 30 };
  const seen = new Set<number>();
  for (let turn = 0; turn < 8; turn++) {
    const visible = await page.evaluate(
      ([width, height]) => {
        const blocks = new Set<number>();
        for (let x = 0; x < width; x += 6)
          for (let y = 0; y < height; y += 6) {
            const body = window.museum.tower!.blockAt(x, y);
            if (body !== null) blocks.add(body);
          }
        return [...blocks];
      },
      [box.width, box.height],
    );
    visible.forEach(body => seen.add(body));
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    // An eighth of a turn at 0.007 rad/px.
    await drag(session, from, { x: from.x + Math.PI / 4 / 0.007, y: from.y }, 4);
    await page.mouse.up();
    await session.settled(() => window.museum.tower!.camera);
  }
  expect(seen.size).toBe(18);
});
