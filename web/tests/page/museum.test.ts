// The museum: the tower of 2003 under the hand of the game, its ghost over the engine's tower, and
// the methods in the plane.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { EXHIBITS } from '../../src/museum/catalogue';
import type { Method } from '../../src/museum/protocol';
import { contrast, displacements, drag, host, Session, type Host } from './browser';
import { facing, open, simulate, SMALL, tower } from './museum-page';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

const METHODS = EXHIBITS.map(e => e.method);

test('opens without a complaint, makes no requests elsewhere, and draws the tower and every method', async () => {
  const foreign: string[] = [];
  await using session = await open(chrome, 'quality=low&scale=0.5', {
    before: async page => {
      page.on('request', request => {
        if (!/^(http:\/\/127\.0\.0\.1:|data:|blob:)/.test(request.url())) foreign.push(request.url());
      });
    },
  });
  const { page } = session;
  expect(await contrast(page, '#picture', [0.35, 0.3, 0.3, 0.5]), 'the tower').toBeGreaterThan(10);
  for (const method of METHODS) {
    const canvas = page.locator(`[data-method="${method}"] canvas`);
    await canvas.scrollIntoViewIfNeeded();
    await page.waitForFunction(m => (window.museum.plane(m).counts?.time ?? 0) > 0.01, method);
    expect(await contrast(page, `[data-method="${method}"] canvas`), method).toBeGreaterThan(10);
  }
  expect(session.complaints).toEqual([]);
  expect(foreign).toEqual([]);
});

test('a block of the tower of 2003 comes out under the mouse, and its springs can be seen', async () => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  const before = await tower(page);
  expect(before).toMatchObject({ show: 'old', count: 18, ghost: null });
  await simulate(page, 0.5);
  const { body, at, out } = (await facing(page))!;
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await drag(session, at, out, 25, 0.04);
  await simulate(page, 0.7);
  expect((await tower(page)).hand).toMatchObject({ body });
  await page.mouse.up();
  const moved = displacements(before.poses, (await tower(page)).poses);
  expect(moved[body], 'displacement of the block, m').toBeGreaterThan(0.03);
  expect(Math.min(...moved), 'a block that hardly moved, m').toBeLessThan(0.005);
  await page.click('#springs');
  await page.waitForFunction(() => window.museum.tower!.springs === 18 * 28);
  await page.waitForFunction(() => /^up to [\d.]+ m?N$/.test(document.getElementById('n-springs')!.textContent!));
  await session.rebuild(() => page.click('#restart'));
  expect(session.complaints).toEqual([]);
});

test('the ghost takes each frame with the engine and the same hand, and the page says how far the two are apart', async () => {
  await using session = await open(chrome, `${SMALL}&show=both`);
  const { page } = session;
  const read = () =>
    page.evaluate(() => {
      const { poses, ghost, costs, time } = window.museum.tower!;
      const readout = document.getElementById('n-apart')!.textContent!;
      return { poses, ghost: ghost!, costs: costs!, time, readout };
    });
  await simulate(page, 1);
  const rest = await read();
  expect(rest.ghost.length).toBe(rest.poses.length);
  expect(rest.costs.old! > 0 && rest.costs.engine! > 0, 'both are timed').toBe(true);
  const atRest = displacements(rest.poses, rest.ghost);
  expect(Math.max(...atRest), 'two towers at rest, m').toBeLessThan(0.002);
  expect(Math.max(...atRest), 'no copy of one another, m').toBeGreaterThan(1e-6);
  const { body, at, out } = (await facing(page))!;
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await drag(session, at, out, 25, 0.04);
  await simulate(page, 0.7);
  const pulled = await read();
  await page.mouse.up();
  expect(displacements(rest.poses, pulled.poses)[body], 'displacement of the engine’s block, m').toBeGreaterThan(0.03);
  expect(displacements(rest.ghost, pulled.ghost)[body], 'displacement of the ghost’s block, m').toBeGreaterThan(0.03);
  expect(Math.max(...displacements(pulled.poses, pulled.ghost)), 'the old method disturbs more, m').toBeGreaterThan(
    2 * Math.max(...atRest),
  );
  await page.keyboard.press(' ');
  expect(await page.getAttribute('#pause', 'aria-pressed'), 'the tower has the focus').toBe('true');
  await session.settled(() => [window.museum.tower!.time, document.getElementById('n-apart')!.textContent]);
  // The readout is written four times a second.
  await page.waitForTimeout(300);
  await session.settled(() => document.getElementById('n-apart')!.textContent);
  const still = await read();
  const max = 1000 * Math.max(...displacements(still.poses, still.ghost));
  expect(still.readout).toMatch(/^\d+(\.\d+)? mm$/);
  expect(Number.parseFloat(still.readout)).toBeCloseTo(max, 1);
  expect(session.complaints).toEqual([]);
});

test('the method is chosen with the keys, and the tower stands still while it is not seen', async () => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  await page.focus('input[value="old"]');
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction(() => window.museum.tower!.show === 'engine' && window.museum.tower!.costs?.old === null);
  expect(await page.isVisible('#n-old')).toBe(false);
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction(() => window.museum.tower!.ghost !== null);
  // Keys scroll the page, and do not turn the camera, unless the tower has the focus.
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  const corner = () => page.evaluate(() => window.museum.tower!.screenOf(0, [0.04, 0, 0]));
  // The towers settle before the camera is observed.
  await session.simulate(0.5);
  await session.settled(() => window.museum.tower!.camera);
  const before = await corner();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowRight');
  await session.settled(() => window.museum.tower!.camera);
  expect(Math.abs((await corner()).x - before.x), 'px').toBeLessThan(1);
  await page.focus('#picture');
  await page.keyboard.press('ArrowRight');
  await session.settled(() => window.museum.tower!.camera);
  expect(Math.abs((await corner()).x - before.x), 'px').toBeGreaterThan(4);
  await page.locator('[data-method="penalty"] canvas').scrollIntoViewIfNeeded();
  const passed = async () => {
    const { time } = await tower(page);
    await page.waitForTimeout(400);
    return (await tower(page)).time - time;
  };
  await expect.poll(passed, { timeout: 60_000 }).toBe(0);
  expect(session.complaints).toEqual([]);
});

/** Scrolls to an exhibit, and waits for its worker. */
async function visit(page: Page, method: Method) {
  const canvas = page.locator(part(method, 'canvas'));
  await canvas.scrollIntoViewIfNeeded();
  await page.waitForFunction(m => window.museum.plane(m).counts !== null, method);
  return canvas;
}

const plane = (page: Page, method: Method) => page.evaluate(m => window.museum.plane(m), method);
const part = (method: Method, name: string) => `[data-method="${method}"] [data-part="${name}"]`;
const stack = (method: Method) =>
  String(EXHIBITS.find(e => e.method === method)!.sceneries.findIndex(s => s.setting === 'stack'));

test.each(METHODS)('%s: runs, takes a block more, a pointer pulls, and it begins again', async method => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  const canvas = await visit(page, method);
  await page.selectOption(part(method, 'scenery'), stack(method));
  await page.waitForFunction(
    m => window.museum.plane(m).scene === 2 && window.museum.plane(m).counts!.time > 0.1,
    method,
  );
  const first = await plane(page, method);
  await page.click(part(method, 'drop'));
  await page.waitForFunction(([m, n]) => window.museum.plane(m).blocks === n, [method, first.blocks + 1] as const);
  await page.click(part(method, 'restart'));
  await page.waitForFunction(m => window.museum.plane(m).scene === 3, method);
  expect((await plane(page, method)).blocks).toBe(first.blocks);

  // The top block is pulled up by the mouse.
  const topOf = (corners: number[]) => Math.max(...corners.filter((_, i) => i % 2 === 1));
  await page.waitForFunction(m => window.museum.plane(m).counts!.time > 0.05, method);
  const top = topOf((await plane(page, method)).corners);
  await canvas.scrollIntoViewIfNeeded();
  const box = (await canvas.boundingBox())!;
  const at = await page.evaluate(([m, y]) => window.museum.planeAt(m, 0, y), [method, top - 0.009] as const);
  const to = await page.evaluate(([m, y]) => window.museum.planeAt(m, 0, y), [method, top + 0.021] as const);
  await page.mouse.move(box.x + at.x, box.y + at.y);
  await page.mouse.down();
  await drag(session, { x: box.x + at.x, y: box.y + at.y }, { x: box.x + to.x, y: box.y + to.y }, 12);
  await page.waitForFunction(
    ([m, y]) => Math.max(...window.museum.plane(m).corners.filter((_, i) => i % 2 === 1)) > y,
    [method, top + 0.01] as const,
  );
  await page.mouse.up();
  // Stopped, it takes single steps.
  await page.click(part(method, 'single'));
  expect(await page.inputValue(part(method, 'speed'))).toBe('0');
  const passed = async () => {
    const { counts } = await plane(page, method);
    await page.waitForTimeout(200);
    return (await plane(page, method)).counts!.time - counts!.time;
  };
  await expect.poll(passed, { timeout: 60_000 }).toBe(0);
  const { counts } = await plane(page, method);
  await page.click(part(method, 'single'));
  await page.waitForFunction(([m, t]) => window.museum.plane(m).counts!.time > t, [method, counts!.time] as const);
  const after = (await plane(page, method)).counts!.time - counts!.time;
  expect(after, 'time of one step, s').toBeLessThan(0.005);
  expect(session.complaints).toEqual([]);
});

test('a falling stack reaches the limit of the constraints (Figure 3.3) and needs a couple of rounds of springs (Figure 3.5)', async () => {
  await using session = await open(chrome, SMALL);
  const { page } = session;
  const numbers = async (method: Method) => {
    await visit(page, method);
    await page.selectOption(part(method, 'speed'), '1');
    await page.waitForFunction(m => window.museum.plane(m).counts!.time > 0.15, method);
    const counter = await page.textContent(`${part(method, 'counters')} div:nth-child(2) dd`);
    return { most: Number(counter!.split('max ')[1]), cut: (await plane(page, method)).counts!.cut };
  };
  const constraint = await numbers('constraint');
  expect(constraint.most).toBe(1000);
  expect(constraint.cut).toBeGreaterThan(0);
  const springs = await numbers('springs');
  expect(springs.most).toBeLessThanOrEqual(3);
  expect(springs.cut).toBe(0);
});

test.each([
  [390, 844],
  [360, 640],
  [1280, 800],
])('at %i x %i nothing leaves the page sideways, and targets are large enough', async (width, height) => {
  const phone = width < 1000;
  await using session = await open(chrome, SMALL, { viewport: { width, height }, hasTouch: phone, isMobile: phone });
  const problems = await session.page.evaluate(() => {
    const found: string[] = [];
    for (const element of document.querySelectorAll<HTMLElement>('button, a, select, .segments label, canvas')) {
      const box = element.getBoundingClientRect();
      if (box.width === 0) continue;
      const name = element.id || element.dataset.part || element.textContent;
      if (box.width < 43.5 || box.height < 43.5)
        found.push(`${name} is ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`);
      if (box.left < 0 || box.right > innerWidth + 0.5) found.push(`${name} leaves the page`);
      if (element.tagName === 'BUTTON' && element.scrollWidth > element.clientWidth + 1)
        found.push(`${name} is too narrow for its text`);
    }
    if (document.documentElement.scrollWidth > innerWidth) found.push('the page scrolls sideways');
    return found;
  });
  expect(problems).toEqual([]);
});

test('the game leads to the museum and back', async () => {
  await using session = await Session.open(
    chrome,
    'help=0&view=small&scale=0.2&form=rigid&stiffness=1e6&render=once&rows=3',
  );
  const { page } = session;
  await page.click('#settings');
  await page.click('#panel a');
  await page.waitForFunction(() => window.museum?.tower?.ready);
  await page.click('#head a');
  await page.waitForFunction(() => window.teeter !== undefined);
  expect(session.complaints).toEqual([]);
});

test('without WebGL the plane is still there', async () => {
  await using session = await Session.open(chrome, SMALL, {
    path: 'museum.html',
    ready: false,
    before: page =>
      page.addInitScript(() => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
          return kind === '2d' ? Reflect.apply(original, this, [kind, ...rest]) : null;
        } as typeof original;
      }),
  });
  const { page } = session;
  await page.waitForSelector('#stage.without');
  expect(await page.isVisible('#stage .instead')).toBe(true);
  await page.locator(part('springs', 'canvas')).scrollIntoViewIfNeeded();
  await page.waitForFunction(() => (window.museum.plane('springs').counts?.time ?? 0) > 0.01);
});
