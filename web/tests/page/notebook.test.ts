// The widget of notebooks in a page of its own, with a model as anywidget has it.

import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import type { Values } from '../../src/notebook/model';
import { contrast, host, Session, type Host } from './browser';

const BUNDLE = fileURLToPath(new URL('../../../python/teeter/notebook/static/widget.js', import.meta.url));
/** Largest size of the module, compressed, bytes. */
const MAX_SIZE = 300_000;
/** Size of a block, m; rows of the tower, and its blocks. */
const SIZE = [0.081, 0.0268, 0.018];
const ROWS = 4;
const COUNT = 3 * ROWS;
/** The block in the middle of the top row, and its travel from state to state, m. */
const TOP = COUNT - 2;
const TRAVEL = 0.03;
const STATES = 4;

let chrome: Host;
beforeAll(async () => {
  if (!existsSync(BUNDLE)) throw new Error('the widget is not built: npm run build');
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** Poses of a tower whose top block is drawn out by a distance, m. */
function tower(out: number): number[] {
  return Array.from({ length: COUNT }, (_, body) => {
    const [row, cell] = [Math.floor(body / 3), body % 3];
    const across = (cell - 1) * (SIZE[1] + 0.0003);
    const z = (row + 0.5) * SIZE[2];
    const along = body === TOP ? out : 0;
    return row % 2 === 0 ? [along, across, z, 0, 0, 0, 1] : [across, along, z, 0, 0, Math.SQRT1_2, Math.SQRT1_2];
  }).flat();
}

/** A motion in which the top block is drawn out. */
const MOTION = Array.from({ length: STATES }, (_, state) => tower(state * TRAVEL)).flat();

/** Part of the page that the tests reach. */
interface Fixture {
  model: {
    values: Record<string, unknown>;
    saves: number;
    set(name: string, value: unknown): void;
  };
  bytes(values: number[]): DataView;
  dispose(): void;
}

const PAGE = `<!doctype html><title>Widget</title><div id="cell" style="width: 240px"></div><div id="other" style="width: 60px"></div><script type="module">
import widget from './widget.js';
const listeners = {};
// A view on a part of a buffer, as messages are, that begins at no multiple of four.
const bytes = values => {
  const data = new Uint8Array(new Float32Array(values).buffer);
  const buffer = new Uint8Array(data.length + 1);
  buffer.set(data, 1);
  return new DataView(buffer.buffer, 1);
};
const model = {
  values: window.initial,
  saves: 0,
  get: name => model.values[name],
  set(name, value) {
    if (model.values[name] === value) return;
    model.values[name] = value;
    for (const listener of listeners['change:' + name] ?? []) listener();
  },
  save_changes: () => model.saves++,
  on: (event, callback) => (listeners[event] ??= new Set()).add(callback),
  off: (event, callback) => listeners[event]?.delete(callback),
};
for (const name of ['sizes', 'poses', 'readings']) model.values[name] = bytes(model.values[name]);
const dispose = widget.render({ model, el: document.getElementById('cell') });
if (model.values.views === 2) widget.render({ model, el: document.getElementById('other') });
window.fixture = { model, bytes, dispose };
</script>`;

/** Opens a page with the widget. */
async function open(values: Partial<Record<keyof Values | 'views', unknown>> = {}): Promise<Session> {
  const initial = {
    sizes: Array.from({ length: COUNT }, () => SIZE).flat(),
    poses: MOTION,
    readings: [],
    interval: 0.1,
    frame: 0,
    playing: false,
    selected: -1,
    height: 220,
    ...values,
  };
  const session = await Session.open(chrome, '', {
    path: 'widget.html',
    ready: false,
    // As on a phone: a coarse shadow, and a camera that moves at once.
    hasTouch: true,
    isMobile: true,
    viewport: { width: 320, height: 420 },
    reducedMotion: 'reduce',
    before: async page => {
      await page.addInitScript(value => Object.assign(window, { initial: value }), initial);
      await page.route('**/widget.html*', route => route.fulfill({ contentType: 'text/html', body: PAGE }));
      await page.route('**/widget.js', route => route.fulfill({ contentType: 'text/javascript', path: BUNDLE }));
    },
  });
  await session.page.waitForFunction(() => 'fixture' in window);
  await drawn(session.page);
  return session;
}

/** Waits until the picture is the same twice. */
async function drawn(page: Page): Promise<Buffer> {
  const canvas = page.locator('canvas').first();
  for (let before = await canvas.screenshot(); ;) {
    const now = await canvas.screenshot();
    if (now.equals(before)) return now;
    before = now;
  }
}

const value = (page: Page, name: keyof Values) =>
  page.evaluate(key => (window as unknown as { fixture: Fixture }).fixture.model.values[key], name);
const set = (page: Page, name: keyof Values, to: unknown) =>
  page.evaluate(
    ({ name, to }) => {
      const { model, bytes } = (window as unknown as { fixture: Fixture }).fixture;
      model.set(name, Array.isArray(to) ? bytes(to) : to);
    },
    { name, to },
  );

test('the module is small', () => {
  expect(gzipSync(readFileSync(BUNDLE)).length).toBeLessThan(MAX_SIZE);
});

test('the tower is drawn, and the bar scrubs its motion', async () => {
  await using session = await open();
  const { page } = session;
  expect(await contrast(page, 'canvas')).toBeGreaterThan(15);
  const start = await drawn(page);
  await page.focus('input[type=range]');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  expect(await value(page, 'frame')).toBe(2);
  expect(await page.textContent('output')).toBe('0.2 s');
  const out = await drawn(page);
  expect(out.equals(start)).toBe(false);
  await page.keyboard.press('Home');
  expect(await value(page, 'frame')).toBe(0);
  expect((await drawn(page)).equals(start), 'the picture of the start').toBe(true);
  // Python moves the bar as well.
  await set(page, 'frame', 2);
  expect((await drawn(page)).equals(out), 'the picture of two steps later').toBe(true);
  expect(await page.inputValue('input[type=range]')).toBe('2');
  expect(session.complaints).toEqual([]);
});

test('a motion plays to its end and reports it, and begins again', async () => {
  await using session = await open();
  const { page } = session;
  await page.click('button');
  expect(await value(page, 'playing')).toBe(true);
  await page.waitForFunction(() => !(window as unknown as { fixture: Fixture }).fixture.model.values.playing);
  expect(await value(page, 'frame')).toBe(STATES - 1);
  expect(await page.evaluate(() => (window as unknown as { fixture: Fixture }).fixture.model.saves)).toBeGreaterThan(1);
  await set(page, 'interval', 1000);
  await page.focus('input[type=range]');
  await page.keyboard.press(' ');
  expect(await value(page, 'playing')).toBe(true);
  expect(await value(page, 'frame')).toBeLessThan(1);
});

test('two views of a model play it once', async () => {
  await using session = await open({ views: 2, height: 100, interval: 1000 });
  const { page } = session;
  // The larger of two steps in a picture would be that of both views.
  const rates = await page.evaluate(async () => {
    const { model } = (window as unknown as { fixture: Fixture }).fixture;
    model.set('playing', true);
    const next = () => new Promise<number>(resolve => requestAnimationFrame(resolve));
    const found: number[] = [];
    for (let last = { time: await next(), frame: 0 }; found.length < 6;) {
      const time = await next();
      const frame = model.values.frame as number;
      if (last.frame > 0) found.push((1000 * (frame - last.frame)) / ((time - last.time) / 1000));
      last = { time, frame };
    }
    return found;
  });
  const mean = rates.reduce((sum, rate) => sum + rate) / rates.length;
  expect(mean).toBeGreaterThan(0.5);
  expect(mean).toBeLessThan(1.5);
});

test('a state without a motion has no bar, and follows new poses', async () => {
  await using session = await open({ poses: tower(0) });
  const { page } = session;
  expect(await page.isVisible('.teeter-bar')).toBe(false);
  const before = await drawn(page);
  await set(page, 'poses', tower(TRAVEL));
  const after = await drawn(page);
  expect(after.equals(before)).toBe(false);
  await set(page, 'poses', tower(0));
  expect((await drawn(page)).equals(before)).toBe(true);
});

test('an X-ray colours the blocks, writes their forces, and a click describes one', async () => {
  const forces = Array.from({ length: COUNT }, (_, body) => [
    0.4 * (ROWS - 1 - Math.floor(body / 3)),
    body < 2 ? 0.05 : 0.5,
  ]);
  await using session = await open({ poses: tower(0), height: 300 });
  const { page } = session;
  const wood = await drawn(page);
  expect(await page.isVisible('.teeter-scale')).toBe(false);
  await set(page, 'readings', forces.flat());
  await page.waitForSelector('.teeter-figures span:not([hidden])');
  expect((await drawn(page)).equals(wood)).toBe(false);
  expect(await page.textContent('.teeter-text [role=status]')).toBe(`2 of ${COUNT} loose`);
  expect(await page.locator('.teeter-figures .marked').count()).toBe(2);
  expect(await page.locator('.teeter-scale-ticks span').allTextContents()).toEqual(['0.1', '0.3', '1', '3', '10']);
  const box = (await page.locator('canvas').boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const selected = Number(await value(page, 'selected'));
  expect(selected).toBeGreaterThanOrEqual(0);
  expect(await page.textContent('.teeter-text [role=status]')).toMatch(
    new RegExp(`^Block ${selected}: pull 0\\.\\d+ N, carries`),
  );
  await page.mouse.click(box.x + 4, box.y + 4);
  expect(await value(page, 'selected')).toBe(-1);
});

test('keys and pointers move the camera, and an ended view lets go of its model', async () => {
  await using session = await open({ poses: tower(0) });
  const { page } = session;
  const first = await drawn(page);
  await page.focus('canvas');
  await page.keyboard.press('ArrowLeft');
  const turned = await drawn(page);
  expect(turned.equals(first)).toBe(false);
  const box = (await page.locator('canvas').boundingBox())!;
  await page.mouse.move(box.x + 40, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + 90, box.y + 50, { steps: 4 });
  await page.mouse.up();
  expect((await drawn(page)).equals(turned)).toBe(false);
  expect(await value(page, 'selected'), 'a drag is no click').toBe(-1);
  expect(session.complaints).toEqual([]);
  await page.evaluate(() => (window as unknown as { fixture: Fixture }).fixture.dispose());
  await set(page, 'poses', tower(TRAVEL));
  const lost = await page.evaluate(() => document.querySelector('canvas')!.getContext('webgl2')!.isContextLost());
  expect(lost).toBe(true);
});
