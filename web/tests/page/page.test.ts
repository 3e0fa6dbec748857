// The page in a real browser: it loads, it draws, the tower stands, and a game can be played with
// mouse and with touch.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { STIFFNESSES } from '../../src/engine/device';
import { contrast, displacements, drag, host, MEASURED, Session, SMALL, states, tap, type Host } from './browser';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** A block of the top row of which the upper face is seen, and where on the screen. */
function topBlock(page: Page): Promise<{ body: number; x: number; y: number } | null> {
  return page.evaluate(() => {
    for (let body = window.teeter.count - 3; body < window.teeter.count; body++) {
      const at = window.teeter.screenOf(body, [0, 0, window.teeter.sizes[3 * body + 2] / 2]);
      if (window.teeter.blockAt(at.x, at.y) === body) return { body, ...at };
    }
    return null;
  });
}

test('loads without a complaint, makes no requests elsewhere, and draws', async () => {
  const foreign: string[] = [];
  await using session = await Session.open(chrome, 'help=0&quality=medium&scale=0.5', {
    before: async page => {
      page.on('request', request => {
        if (!/^(http:\/\/127\.0\.0\.1:|data:|blob:)/.test(request.url())) foreign.push(request.url());
      });
    },
  });
  // The middle third, where the tower stands, without the controls.
  const spread = await contrast(session.page, '#picture', [1 / 3, 1 / 4, 1 / 3, 1 / 3]);
  expect(spread, 'standard deviation of the brightness, of 255').toBeGreaterThan(15);
  expect(session.complaints).toEqual([]);
  expect(foreign).toEqual([]);
});

test('the tower stands ten seconds, awake', async () => {
  await using session = await Session.open(chrome, `${SMALL}&sleep=0&render=once`);
  await session.simulate(1);
  const before = await session.poses();
  const first = await session.page.evaluate(() => window.teeter.hash());
  await session.simulate(10);
  const after = await session.poses();
  const end = await session.page.evaluate(async () => {
    const { state, count, awake, quarantined } = window.teeter;
    return { state, count, awake, quarantined, hash: await window.teeter.hash() };
  });
  expect(end.count).toBe(54);
  expect(end.awake).toBe(54);
  expect(end.state).toBe('standing');
  expect(end.quarantined).toEqual([]);
  expect(Math.max(...displacements(before, after)), 'largest displacement of a block, m').toBeLessThan(1e-5);
  expect(first.hash).toMatch(/^[0-9a-f]{16}$/);
  expect(end.hash.hash).not.toBe(first.hash);
  expect(session.complaints).toEqual([]);
});

const SIX_ROWS = 'rows=6&seed=5&sleep=0&render=once';

test('the same seed and no hand give the same states', async () => {
  const runs: Map<string, string>[] = [];
  for (let run = 0; run < 2; run++) {
    await using session = await Session.open(chrome, `${SMALL}&${SIX_ROWS}`);
    runs.push(await states(session, 3));
  }
  const common = [...runs[0].keys()].filter(time => runs[1].has(time));
  expect(common.length).toBeGreaterThan(30);
  expect(common.map(time => runs[1].get(time))).toEqual(common.map(time => runs[0].get(time)));
  expect(new Set(runs[0].values()).size, 'states differ from time to time').toBeGreaterThan(30);
});

test('the stiffness that the page chose is shown, and is all that the choice means for the tower', async () => {
  const open = async (query: string) => {
    await using session = await Session.open(chrome, `${MEASURED}&${SIX_ROWS}${query}`);
    const { page } = session;
    const { stiffness, form } = await page.evaluate(() => ({
      stiffness: window.teeter.stiffness,
      form: window.teeter.form.value,
    }));
    const [shown, selected] = [await page.textContent('#stiffness-value'), await page.inputValue('#stiffness')];
    const opened = { stiffness, form, shown, selected, states: await states(session, 2) };
    expect(session.complaints).toEqual([]);
    return opened;
  };
  const own = await open('');
  const { value } = own.stiffness;
  expect(STIFFNESSES).toContain(value);
  expect(own).toMatchObject({
    stiffness: { chosen: true },
    shown: `${value / 1000} N/mm, chosen for this device.`,
    selected: '',
  });
  for (const stiffness of STIFFNESSES) {
    const named = await open(`&form=${own.form}&stiffness=${stiffness}`);
    expect(named).toMatchObject({
      form: own.form,
      stiffness: { value: stiffness, chosen: false },
      shown: '',
      selected: String(stiffness),
    });
    const common = [...own.states.keys()].filter(time => named.states.has(time));
    expect(common.length).toBeGreaterThan(20);
    const equal = common.filter(time => own.states.get(time) === named.states.get(time));
    expect(equal, `times of equal states at ${stiffness} N/m`).toEqual(stiffness === value ? common : []);
  }
});

/**
 * A device that is so many times as slow: all that its worker does takes so many times as long by
 * the worker's clock.
 */
const slower = (times: number) => (page: Page) =>
  page.route('**/worker-*.js', async route => {
    const response = await route.fetch();
    const clock = `{ const now = performance.now.bind(performance); performance.now = () => ${times} * now(); }`;
    await route.fulfill({ response, body: `${clock}\n${await response.text()}` });
  });

test.each([
  [40, 3e5, 'rigid', 'Rigid'],
  [0.03, 3e6, 'lattice', 'Springs inside'],
] as const)(
  'a device that is %f times as slow gets contacts of %f N/m and %s blocks',
  async (times, expected, form, words) => {
    await using session = await Session.open(chrome, `${MEASURED}&render=once`, { before: slower(times) });
    const { page } = session;
    expect(await page.evaluate(() => window.teeter.stiffness)).toEqual({ value: expected, chosen: true });
    expect(await page.evaluate(() => window.teeter.form)).toEqual({ value: form, chosen: true });
    expect(await page.textContent('#form-value')).toBe(`${words}, chosen for this device.`);
    expect(await page.inputValue('#form')).toBe('');
    expect(session.complaints).toEqual([]);
  },
);

test.each([
  [40, 3e5],
  [0.1, 3e6],
])(
  'a device that is %f times as slow gets contacts of %f N/m with rigid blocks that the address names',
  async (times, expected) => {
    await using session = await Session.open(chrome, `${MEASURED}&form=rigid&render=once`, { before: slower(times) });
    expect(await session.page.evaluate(() => window.teeter.stiffness)).toEqual({ value: expected, chosen: true });
    expect(await session.page.evaluate(() => window.teeter.form)).toEqual({ value: 'rigid', chosen: false });
    expect(await session.page.textContent('#form-value')).toBe('');
    expect(session.complaints).toEqual([]);
  },
);

test("the player can choose another stiffness, which stays until the choice is the page's again", async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=6&render=once`);
  const { page } = session;
  const built = (stiffness: { value?: number; chosen: boolean }) =>
    page.waitForFunction(
      expected =>
        window.teeter.stiffness.chosen === expected.chosen &&
        (expected.value ?? window.teeter.stiffness.value) === window.teeter.stiffness.value,
      stiffness,
    );
  await page.click('#settings');
  await page.selectOption('#stiffness', { label: '300 N/mm' });
  await built({ value: 3e5, chosen: false });
  expect(await page.textContent('#stiffness-value')).toBe('');
  await page.click('#new-seed');
  await session.simulate(0.5);
  await session.rebuild(() => page.click('#reset'));
  await built({ value: 3e5, chosen: false });
  await page.selectOption('#stiffness', { label: 'Automatic' });
  await built({ chosen: true });
  expect(await page.textContent('#stiffness-value')).toContain('chosen for this device');
  expect(session.complaints).toEqual([]);
});

/** A loose block below the top rows whose end faces the viewer, or null. */
function findLoose(session: Session) {
  return session.page.evaluate(async () => {
    const { teeter } = window;
    for (let body = 6; body < teeter.count - 9; body++) {
      const contacts = await teeter.contacts(body);
      const load = contacts.filter(c => c.normal[2] < -0.5).reduce((sum, c) => sum + c.force, 0);
      if (load > 1e-3) continue;
      // Of the two ends the one whose middle is seen.
      for (const side of [1, -1]) {
        const end: [number, number, number] = [(side * teeter.sizes[3 * body]) / 2, 0, 0];
        const at = teeter.screenOf(body, end);
        if (teeter.blockAt(at.x, at.y) !== body) continue;
        const inner = teeter.screenOf(body, [0, 0, 0]);
        // An end that faces the viewer shows the block coming out towards the viewer: its travel on
        // the screen goes down.
        if (at.y <= inner.y) continue;
        const out = teeter.screenOf(body, [(side * teeter.sizes[3 * body]) / 2 + side * 0.12, 0, 0]);
        return { body, at, out };
      }
    }
    return null;
  });
}

test('a loose block is pulled out with the mouse, carried, and put on top', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  const { page } = session;
  await session.simulate(2);
  const loose = await findLoose(session);
  expect(loose, 'a loose block').not.toBeNull();
  const { body, at, out } = loose!;
  const before = await session.poses();

  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  expect(await page.evaluate(() => window.teeter.hand?.body)).toBe(body);
  await drag(session, at, out, 60, 0.04);
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  const free = await session.poses();
  const pulled = displacements(before, free);
  expect(pulled[body], 'displacement of the pulled block, m').toBeGreaterThan(0.05);
  expect(Math.max(...pulled.filter((_, i) => i !== body)), 'displacement of any other block, m').toBeLessThan(1e-3);

  await page.waitForFunction(() => window.teeter.slots.length === 3);
  const path = await page.evaluate(b => {
    const here = window.teeter.screenOf(b);
    const there = window.teeter.project(window.teeter.slots[1] as [number, number, number]);
    return { x: there.x - here.x, y: there.y - here.y, slot: window.teeter.slots[1] };
  }, body);
  await drag(session, out, { x: out.x + path.x, y: out.y + path.y }, 60, 0.04);
  await page.waitForFunction(() => window.teeter.hand?.slot);
  await page.mouse.up();
  await page.waitForFunction(() => window.teeter.hand === null);
  await session.simulate(1.5);

  const after = await session.poses();
  const position = after.slice(7 * body, 7 * body + 3);
  expect(Math.hypot(position[0] - path.slot[0], position[1] - path.slot[1]), 'beside its slot, m').toBeLessThan(0.004);
  expect(
    position[2] - Math.max(...after.filter((_, i) => i % 7 === 2 && (i - 2) / 7 !== body)),
    'above the row beneath, m',
  ).toBeGreaterThan(0.01);
  const moved = displacements(before, after);
  expect(Math.max(...moved.filter((_, i) => i !== body)), 'displacement of any other block, m').toBeLessThan(0.005);
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
  expect(session.complaints).toEqual([]);
});

test('a block that was let fall is put on top by the button', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=6&seed=2`);
  const { page } = session;
  await session.simulate(1);
  const before = await session.poses();
  // The block that sticks out least is taken from the top row, swung aside, and let go over the
  // table.
  const top = (await topBlock(page))!;
  const { body } = top;
  await page.mouse.move(top.x, top.y);
  await page.mouse.down();
  await drag(session, top, { x: top.x, y: top.y - 120 }, 20, 0.03);
  await drag(session, { x: top.x, y: top.y - 120 }, { x: top.x + 330, y: top.y - 60 }, 30, 0.04);
  await session.simulate(1);
  await page.mouse.up();
  await session.simulate(2.5);
  const dropped = await session.poses();
  expect(dropped[7 * body + 2], 'height of the block on the table, m').toBeLessThan(0.05);
  expect(await page.evaluate(() => window.teeter.state), 'what the player lets go has not fallen').toBe('standing');
  await page.waitForSelector('#place:enabled');
  await page.click('#place');
  await page.waitForFunction(() => window.teeter.hand?.placing);
  await page.waitForFunction(() => window.teeter.hand === null);
  await session.simulate(1);
  const after = await session.poses();
  expect(Math.abs(after[7 * body + 2] - before[7 * body + 2]), 'back at the height of the top row, m').toBeLessThan(
    0.001,
  );
  const moved = displacements(before, after);
  expect(Math.max(...moved.filter((_, i) => i !== body)), 'displacement of any other block, m').toBeLessThan(0.002);
});

test('a block that carries the tower does not move, and the page says what holds it', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1&cap=1`);
  const { page } = session;
  await session.simulate(2);
  const heavy = await page.evaluate(async () => {
    const { teeter } = window;
    let best: { body: number; load: number; at: { x: number; y: number }; out: { x: number; y: number } } | null = null;
    for (let body = 0; body < 12; body++) {
      const load = (await teeter.contacts(body)).filter(c => c.normal[2] < -0.5).reduce((sum, c) => sum + c.force, 0);
      for (const side of [1, -1]) {
        const half = (side * teeter.sizes[3 * body]) / 2;
        const at = teeter.screenOf(body, [half, 0, 0]);
        if (teeter.blockAt(at.x, at.y) !== body || at.y <= teeter.screenOf(body).y) continue;
        if (!best || load > best.load)
          best = { body, load, at, out: teeter.screenOf(body, [half + side * 0.05, 0, 0]) };
      }
    }
    return best;
  });
  expect(heavy!.load, 'load on it, N').toBeGreaterThan(2);
  const before = await session.poses();
  await page.mouse.move(heavy!.at.x, heavy!.at.y);
  await page.mouse.down();
  await drag(session, heavy!.at, heavy!.out, 20, 0.03);
  await page.waitForFunction(() => (window.teeter.hand?.holders.length ?? 0) > 0);
  expect(await page.locator('#ring-note').textContent()).toMatch(/held by \d+ blocks?, \d+\.\d N/);
  expect(await page.evaluate(() => window.teeter.hand!.force)).toBeLessThanOrEqual(1.001);
  expect(displacements(before, await session.poses())[heavy!.body], 'displacement of the block, m').toBeLessThan(1e-3);
  await page.keyboard.press('Escape');
  expect(await page.evaluate(() => window.teeter.hand)).toBeNull();
  await page.mouse.up();
});

test('a tap on its end pokes a loose block inwards', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  await session.simulate(2);
  const { body, at } = (await findLoose(session))!;
  const before = await session.poses();
  for (let round = 0; round < 2; round++) {
    await tap(session.page, at);
    await session.simulate(0.8);
  }
  const moved = displacements(before, await session.poses());
  expect(moved[body], 'displacement of the poked block, m').toBeGreaterThan(0.002);
  expect(Math.max(...moved.filter((_, i) => i !== body)), 'displacement of any other block, m').toBeLessThan(1e-3);
  expect(await session.page.evaluate(() => window.teeter.hand)).toBeNull();
});

test('a pause lets the camera turn while a block is held, and the hand goes on after it', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  const { page } = session;
  await session.simulate(1);
  const top = await page.evaluate(() => {
    const { teeter } = window;
    for (let body = teeter.count - 3; body < teeter.count; body++) {
      const at = teeter.screenOf(body, [0, 0, teeter.sizes[3 * body + 2] / 2]);
      if (teeter.blockAt(at.x, at.y) === body) return { body, at };
    }
    return null;
  });
  const { body, at } = top!;
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await drag(session, at, { x: at.x, y: at.y - 60 }, 20, 0.03);
  await session.simulate(0.5);
  const state = () =>
    page.evaluate(() => ({
      camera: window.teeter.camera,
      time: window.teeter.time,
      hand: window.teeter.hand,
      paused: window.teeter.paused,
    }));
  const held = await state();
  expect(held.hand).toMatchObject({ body, grip: 'carry' });

  // While a block is held and time runs, the pointer does not turn the camera.
  await page.keyboard.press(' ');
  const frozen = await state();
  expect(frozen.paused).toBe(true);
  expect(frozen.camera.azimuth).toBe(held.camera.azimuth);
  await drag(session, { x: at.x, y: at.y - 60 }, { x: at.x + 150, y: at.y - 20 }, 15);
  await session.settled(() => window.teeter.camera);
  const turned = await state();
  expect(Math.abs(turned.camera.azimuth - held.camera.azimuth), 'turn of the camera, rad').toBeGreaterThan(0.5);
  expect(turned.hand).toMatchObject({ body, grip: 'carry' });
  await page.waitForTimeout(200);
  expect((await state()).time, 'time stands still').toBe(turned.time);

  const before = await session.poses();
  await page.keyboard.press(' ');
  await session.simulate(0.2);
  await drag(session, { x: at.x + 150, y: at.y - 20 }, { x: at.x + 150, y: at.y - 60 }, 15, 0.03);
  await session.simulate(0.5);
  const resumed = await state();
  expect(resumed.hand).toMatchObject({ body, grip: 'carry' });
  expect(resumed.camera.azimuth, 'the camera is still again').toBeCloseTo((await state()).camera.azimuth, 9);
  const after = await session.poses();
  expect(after[7 * body + 2] - before[7 * body + 2], 'rise of the held block, m').toBeGreaterThan(0.01);
  await page.mouse.up();
});

test('a finger on empty space turns the camera, two fingers zoom, and the tower stays', async () => {
  await using session = await Session.open(chrome, SMALL, {
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
    deviceScaleFactor: 2,
  });
  const { page } = session;
  // It comes to rest first: its blocks move by millimetres then.
  await session.simulate(1);
  const before = { camera: await page.evaluate(() => window.teeter.camera), poses: await session.poses() };
  const touch = await page.context().newCDPSession(page);
  const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: { x: number; y: number; id: number }[]) =>
    touch.send('Input.dispatchTouchEvent', { type, touchPoints });
  await send('touchStart', [{ x: 60, y: 250, id: 0 }]);
  for (let k = 1; k <= 10; k++) await send('touchMove', [{ x: 60 + 16 * k, y: 250 + 6 * k, id: 0 }]);
  await send('touchEnd', []);
  await session.settled(() => window.teeter.camera);
  const turned = await page.evaluate(() => window.teeter.camera);
  expect(Math.abs(turned.azimuth - before.camera.azimuth), 'rad').toBeGreaterThan(0.5);
  expect(turned.elevation - before.camera.elevation, 'rad').toBeGreaterThan(0.15);

  const distance = (c: { position: number[] }) => Math.hypot(c.position[0], c.position[1]);
  await send('touchStart', [{ x: 60, y: 160, id: 0 }]);
  await send('touchStart', [
    { x: 60, y: 160, id: 0 },
    { x: 100, y: 200, id: 1 },
  ]);
  for (let k = 1; k <= 10; k++) {
    await send('touchMove', [
      { x: 60 - 3 * k, y: 160 - 3 * k, id: 0 },
      { x: 100 + 6 * k, y: 200 + 6 * k, id: 1 },
    ]);
  }
  await send('touchEnd', []);
  await session.settled(() => window.teeter.camera);
  expect(distance(await page.evaluate(() => window.teeter.camera)) / distance(turned), 'closer by').toBeLessThan(0.8);
  expect(Math.max(...displacements(before.poses, await session.poses()))).toBeLessThan(1e-3);

  // The first finger on a block is the hand, the second moves the block away; the camera stands
  // still.
  await page.keyboard.press('f');
  await session.settled(() => window.teeter.camera);
  const top = (await topBlock(page))!;
  const camera = await page.evaluate(() => window.teeter.camera);
  await send('touchStart', [{ x: top.x, y: top.y, id: 0 }]);
  for (let k = 1; k <= 10; k++) await send('touchMove', [{ x: top.x, y: top.y - 5 * k, id: 0 }]);
  await session.simulate(0.6);
  const raised = (await session.poses()).slice(7 * top.body, 7 * top.body + 3);
  expect(raised[2] - before.poses[7 * top.body + 2], 'rise of the block under the finger, m').toBeGreaterThan(0.01);
  const first = { x: top.x, y: top.y - 50, id: 0 };
  await send('touchStart', [first, { x: 60, y: 600, id: 1 }]);
  for (let k = 1; k <= 10; k++) await send('touchMove', [first, { x: 60, y: 600 - 8 * k, id: 1 }]);
  await session.simulate(0.6);
  const away = (await session.poses()).slice(7 * top.body, 7 * top.body + 3);
  const sight = [away[0] - raised[0], away[1] - raised[1]];
  expect(
    -(sight[0] * camera.position[0] + sight[1] * camera.position[1]) /
      Math.hypot(camera.position[0], camera.position[1]),
    'displacement from the viewer, m',
  ).toBeGreaterThan(0.02);
  expect(await page.evaluate(() => window.teeter.camera)).toEqual(camera);
  await send('touchEnd', []);
  expect(await page.evaluate(() => window.teeter.hand)).toBeNull();
  expect(session.complaints).toEqual([]);
});

test('controls: a new seed, fewer rows, another scene, reset', async () => {
  await using session = await Session.open(chrome, `${SMALL}&render=once`);
  const { page } = session;
  await page.click('#settings');
  await page.locator('#rows').fill('4');
  await page.locator('#rows').dispatchEvent('change');
  await page.waitForFunction(() => window.teeter.count === 12);
  const heights = () => page.evaluate(() => window.teeter.sizes.filter((_, i) => i % 3 === 2));
  const first = await heights();
  await page.click('#new-seed');
  const seed = await page.inputValue('#seed');
  expect(seed).not.toBe('1');
  await expect.poll(heights, { timeout: 60_000 }).not.toEqual(first);
  await page.selectOption('#scene', 'column');
  await page.waitForFunction(() => window.teeter.count === 10);
  await session.simulate(0.5);
  await session.rebuild(() => page.click('#reset'));
  expect(await page.evaluate(() => window.teeter.count)).toBe(10);
  expect(session.complaints).toEqual([]);
});

test('a scene of the gallery is built, and every picture is there', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`);
  const { page } = session;
  await page.click('#settings');
  await page.click('#gallery-open');
  const pictures = page.locator('#gallery img');
  await expect
    .poll(() => pictures.evaluateAll(all => all.map(i => (i as HTMLImageElement).naturalWidth)))
    .toEqual(Array.from({ length: 12 }, () => 384));
  await session.rebuild(() => page.click('#gallery button:has(img[src*="arch"])'));
  expect(await page.evaluate(() => window.teeter.count)).toBe(13);
  expect(await page.inputValue('#scene')).toBe('arch');
  expect(await page.locator('#gallery').isVisible()).toBe(false);
  await session.simulate(2);
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
  expect(session.complaints).toEqual([]);
});

test('a page without WebGL or without the engine says so in words', async () => {
  const trouble = async (before: (page: Page) => Promise<unknown> | void) => {
    await using session = await Session.open(chrome, SMALL, { before, ready: false });
    await session.page.waitForSelector('#trouble:not([hidden])');
    return await session.page.textContent('#trouble-text');
  };
  const noDrawing = (page: Page) =>
    page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
  expect(await trouble(noDrawing)).toContain('WebGL');
  expect(await trouble(page => page.route('**/*.wasm', route => route.abort()))).toContain('engine');
  expect(await trouble(page => page.addInitScript(() => Object.assign(window, { Worker: undefined })))).toContain(
    'workers',
  );
});
