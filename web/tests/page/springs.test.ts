// Springs inside the blocks: the page gives and takes them on a tower that stands, compresses it
// and lets it rise, and shows what they do.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { DIAL, stepOf } from '../../src/ui/springs-dial';
import { displacements, host, Session, SMALL, SPRUNG, states, type Host } from './browser';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** A tower whose frame with springs even a busy machine has done soon. */
const SIX_ROWS = 'rows=6&seed=5&sleep=0&render=once';

const become = (page: Page, form: string) => page.waitForFunction(f => window.teeter.form.value === f, form);

/** Turns the dial, and waits for the springs to be as stiff. */
async function dial(page: Page, stiffness: number) {
  await page.locator('#springs').fill(String(stepOf(stiffness)));
  await page.waitForFunction(k => window.teeter.springs === k, stiffness);
}

const top = async (session: Session) => Math.max(...(await session.poses()).filter((_, i) => i % 7 === 2));

test('a standing tower gets springs and loses them, and no block moves by a tenth of a millimetre', async () => {
  await using session = await Session.open(chrome, `${SMALL}&sleep=0&render=once`);
  const { page } = session;
  await session.simulate(1);
  expect(await page.evaluate(() => ({ form: window.teeter.form, springs: window.teeter.springs }))).toEqual({
    form: { value: 'rigid', chosen: false },
    springs: null,
  });
  await page.click('#settings');
  expect(await page.inputValue('#form')).toBe('rigid');
  expect(await page.isVisible('#springs')).toBe(false);
  const before = await session.poses();
  for (const [form, springs] of [
    ['lattice', 1e6],
    ['rigid', null],
  ] as const) {
    await page.selectOption('#form', form);
    await become(page, form);
    expect(await page.evaluate(() => window.teeter.springs)).toBe(springs);
    expect(await page.isVisible('#springs')).toBe(springs !== null);
    await session.simulate(0.5);
    expect(
      Math.max(...displacements(before, await session.poses())),
      `displacement of a block, m, ${form}`,
    ).toBeLessThan(1e-4);
  }
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
  expect(session.complaints).toEqual([]);
});

test('soft springs compress the tower, stiff ones raise it again, and neither is a fall', async () => {
  await using session = await Session.open(chrome, `${SPRUNG}&rows=12&seed=5&sleep=0&render=once`);
  const { page } = session;
  await session.simulate(0.5);
  await page.click('#settings');
  expect(await page.textContent('#springs-value')).toBe('1000 N/mm');
  const before = await top(session);
  await dial(page, DIAL.min);
  expect(await page.textContent('#springs-value')).toBe('1 N/mm');
  await session.simulate(1.5);
  const soft = await top(session);
  expect(before - soft, 'sunk by, m').toBeGreaterThan(0.003);
  expect(before - soft, 'sunk by, m').toBeLessThan(0.03);
  expect(await page.evaluate(() => window.teeter.state)).not.toBe('fallen');
  await dial(page, 1e6);
  expect(await page.textContent('#springs-same')).toBe('as the contacts');
  await session.simulate(0.5);
  expect(Math.abs((await top(session)) - before), 'back by, m').toBeLessThan(1e-4);
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
  expect(session.complaints).toEqual([]);
});

test('a jelly tower becomes rigid without a hop', async () => {
  await using session = await Session.open(chrome, `${SPRUNG}&springs=3e3&${SIX_ROWS}`);
  const { page } = session;
  expect(await page.evaluate(() => window.teeter.springs)).toBe(3e3);
  await session.simulate(1);
  const soft = await top(session);
  await page.click('#settings');
  await page.selectOption('#form', 'rigid');
  let highest = soft;
  while ((await page.evaluate(() => window.teeter.form.value)) !== 'rigid')
    highest = Math.max(highest, await top(session));
  await session.simulate(0.5);
  const rigid = await top(session);
  expect(rigid).toBeGreaterThan(soft);
  expect(highest - rigid, 'over the end, m').toBeLessThan(2e-4);
  expect(await page.evaluate(() => window.teeter.state)).toBe('standing');
});

/** The middle of the picture, as pixels. */
async function pixels(page: Page): Promise<number[]> {
  const picture = await page.locator('#picture').screenshot();
  return page.evaluate(async data => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(120, 200);
    const context = canvas.getContext('2d')!;
    context.drawImage(image, image.width / 2 - 60, image.height / 2 - 100, 120, 200, 0, 0, 120, 200);
    return [...context.getImageData(0, 0, 120, 200).data];
  }, picture.toString('base64'));
}

/** Part of the pixels that differ to the eye. */
function difference(a: number[], b: number[]): number {
  let count = 0;
  for (let i = 0; i < a.length; i += 4)
    if (Math.max(...[0, 1, 2].map(k => Math.abs(a[i + k] - b[i + k]))) > 24) count += 1;
  return count / (a.length / 4);
}

test('the springs view draws springs in see-through blocks, with a legend in newtons, and wood comes back', async () => {
  await using session = await Session.open(
    chrome,
    `help=0&quality=low&scale=0.5&form=lattice&stiffness=1e6&${SIX_ROWS}`,
  );
  const { page } = session;
  // The scale has settled by then, and a picture that is due has been drawn.
  const drawn = async () => {
    await page.waitForTimeout(2500);
    await session.settled(() => window.teeter.ready);
  };
  await session.simulate(0.5);
  await drawn();
  const wood = await pixels(page);
  await page.keyboard.press('s');
  await page.waitForFunction(() => window.teeter.view.shown === 18 * 28);
  await drawn();
  const springs = await pixels(page);
  expect(difference(wood, springs), 'part of the picture that changed').toBeGreaterThan(0.3);
  expect(await page.getAttribute('#springs-toggle', 'aria-pressed')).toBe('true');
  const { scale } = await page.evaluate(() => window.teeter.view);
  expect(scale, 'N, of springs that carry five rows').toBeGreaterThan(0.05);
  expect(scale).toBeLessThan(10);
  const values = (await page.locator('#scale-values span').allTextContents()).map(Number);
  expect(values.length).toBe(5);
  expect([values[1], values[2], values[3]]).toEqual([values[3], 0, values[1]]);
  expect(values[0] / values[1]).toBeCloseTo(4, 0);
  expect(await page.textContent('#scale-unit')).toMatch(/^m?N$/);
  // Dark blue rods that push, whatever else is drawn.
  let pushing = 0;
  for (let i = 0; i < springs.length; i += 4) if (springs[i + 2] > springs[i] + 30) pushing += 1;
  expect(pushing, 'blue pixels').toBeGreaterThan(10);
  await page.click('#springs-toggle');
  await page.waitForFunction(() => window.teeter.view.shown === 0);
  await drawn();
  expect(difference(wood, await pixels(page)), 'part of the picture that is not as before').toBeLessThan(0.02);
  expect(session.complaints).toEqual([]);
});

test('springs are shown while time stands still, and rigid blocks are offered some', async () => {
  await using session = await Session.open(chrome, `${SMALL}&${SIX_ROWS}`);
  const { page } = session;
  await page.click('#springs-toggle');
  expect(await page.isVisible('#scale')).toBe(false);
  await page.click('#use-springs');
  await become(page, 'lattice');
  expect(await page.inputValue('#form')).toBe('lattice');
  await page.waitForFunction(() => window.teeter.view.shown > 0);
  await page.keyboard.press('s');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => window.teeter.view.shown === 0 && window.teeter.paused);
  await page.keyboard.press('s');
  await page.waitForFunction(() => window.teeter.view.shown > 0);
  expect(session.complaints).toEqual([]);
});

test('a block of jelly is taken by the hand where it is seen', async () => {
  await using session = await Session.open(chrome, `${SPRUNG}&springs=1e4&${SIX_ROWS.replace('&render=once', '')}`);
  const { page } = session;
  await session.simulate(1);
  const { body, at } = (await page.evaluate(() => {
    const { teeter } = window;
    for (let body = teeter.count - 3; body < teeter.count; body++) {
      const at = teeter.screenOf(body, [0, 0, teeter.sizes[3 * body + 2] / 2]);
      if (teeter.blockAt(at.x, at.y) === body) return { body, at };
    }
    return null;
  }))!;
  const before = await session.poses();
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  for (let k = 1; k <= 20; k++) {
    await page.mouse.move(at.x, at.y - 4 * k);
    await session.simulate(0.03);
  }
  await session.simulate(0.5);
  expect(await page.evaluate(() => window.teeter.hand)).toMatchObject({ body, grip: 'carry' });
  const moved = (await session.poses())[7 * body + 2] - before[7 * body + 2];
  expect(moved, 'rise of the block, m').toBeGreaterThan(0.01);
  await page.mouse.up();
  expect(session.complaints).toEqual([]);
});

test('the same address gives the same states, springs and all', async () => {
  const runs: Map<string, string>[] = [];
  for (let run = 0; run < 2; run++) {
    await using session = await Session.open(chrome, `${SPRUNG}&springs=1e5&${SIX_ROWS}`);
    runs.push(await states(session, 1.5));
  }
  const common = [...runs[0].keys()].filter(time => runs[1].has(time));
  expect(common.length).toBeGreaterThan(20);
  expect(common.map(time => runs[1].get(time))).toEqual(common.map(time => runs[0].get(time)));
});
