// The X-ray on the page: figures on blocks of a tower at rest, none while it moves, and what it
// calls loose comes out.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { displacements, host, Session, SMALL, SPRUNG, type Host } from './browser';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

const known = (session: Session) =>
  session.page.waitForFunction(() => window.teeter.xray.pulls !== null && window.teeter.xray.shown > 0);
const figures = (session: Session) => session.page.locator('#labels span:visible').allTextContents();

test('the X-ray writes the pull on blocks of a tower at rest, and counts the loose ones as the study does', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  const { page } = session;
  await session.simulate(1.5);
  expect(await page.isVisible('#xray')).toBe(false);
  await page.click('#xray-toggle');
  await known(session);
  expect(await page.getAttribute('#xray-toggle', 'aria-pressed')).toBe('true');
  // As many as teeter_study finds in this tower: crates/wasm and tests/wasm.test.mjs hold the same
  // number.
  expect(await page.textContent('#xray-count')).toBe('27 of 54 loose');
  const written = await figures(session);
  expect(written.length).toBeGreaterThan(30);
  for (const text of written) expect(text).toMatch(/^\d*\.\d+$/);
  const { pulls, loads } = await page.evaluate(() => window.teeter.xray);
  expect(pulls!.filter(pull => pull !== null && pull < 0.1).length).toBe(27);
  expect(Math.max(...(pulls as number[])), 'N, of the tightest').toBeGreaterThan(3);
  expect(Math.max(...loads!), 'N, of the most loaded').toBeLessThan(10.3);
  expect(await page.locator('#labels .marked').count()).toBe(27);
  await page.keyboard.press('x');
  expect(await figures(session)).toEqual([]);
  expect(await page.isVisible('#xray')).toBe(false);
  expect(session.complaints).toEqual([]);
});

test('a block that the X-ray calls loose comes out by the mouse while the tower stands, and figures come back when it rests', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  const { page } = session;
  await page.keyboard.press('x');
  await known(session);
  const loose = await page.evaluate(() => {
    const { teeter } = window;
    for (let body = 6; body < teeter.count - 9; body++) {
      const pull = teeter.xray.pulls![body];
      if (pull === null || pull >= 0.1) continue;
      for (const side of [1, -1]) {
        const half = (side * teeter.sizes[3 * body]) / 2;
        const at = teeter.screenOf(body, [half, 0, 0]);
        if (teeter.blockAt(at.x, at.y) !== body || at.y <= teeter.screenOf(body).y) continue;
        return { body, at, out: teeter.screenOf(body, [half + side * 0.12, 0, 0]) };
      }
    }
    return null;
  });
  expect(loose, 'a loose block whose end faces the viewer').not.toBeNull();
  const { body, at, out } = loose!;
  const before = await session.poses();
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.waitForFunction(() => window.teeter.xray.pulls === null);
  expect(await page.textContent('#xray-count')).toBe('settling…');
  expect(await figures(session)).toEqual([]);
  for (let k = 1; k <= 60; k++) {
    await page.mouse.move(at.x + ((out.x - at.x) * k) / 60, at.y + ((out.y - at.y) * k) / 60);
    await session.simulate(0.04);
  }
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  const moved = displacements(before, await session.poses());
  expect(moved[body], 'displacement of the loose block, m').toBeGreaterThan(0.05);
  expect(Math.max(...moved.filter((_, i) => i !== body)), 'displacement of any other block, m').toBeLessThan(1e-3);
  expect(await page.evaluate(() => window.teeter.state)).not.toBe('fallen');
  await page.mouse.up();
  await known(session);
  expect(await page.textContent('#xray-count')).toMatch(/^\d+ of 54 loose$/);
  expect(session.complaints).toEqual([]);
});

test('the X-ray shows blocks of springs as well, and blocks that lie about', async () => {
  await using session = await Session.open(chrome, `${SPRUNG}&rows=4&seed=3`);
  const { page } = session;
  await page.keyboard.press('x');
  await known(session);
  expect(
    (await page.evaluate(() => window.teeter.xray.pulls!.slice(-3))).every(pull => pull !== null && pull < 0.1),
  ).toBe(true);
  await page.keyboard.press('s');
  expect(await page.evaluate(() => window.teeter.xray.on), 'springs instead').toBe(false);
  await page.keyboard.press('x');
  expect(await page.evaluate(() => window.teeter.view.springs)).toBe(false);
  await page.click('#settings');
  await page.selectOption('#scene', 'pile');
  await page.waitForFunction(() => window.teeter.count === 40);
  await page.waitForFunction(() => window.teeter.xray.pulls !== null);
  const { pulls } = await page.evaluate(() => window.teeter.xray);
  expect(pulls!.filter(pull => pull !== null).length, 'blocks of the heap that lie').toBeGreaterThan(5);
  expect(pulls, 'a block of the heap that does not lie').toContain(null);
  expect(session.complaints).toEqual([]);
});

test('while time stands still the X-ray of a tower at rest can be read', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=6&seed=5`);
  const { page } = session;
  await session.simulate(1.5);
  await page.keyboard.press(' ');
  await page.keyboard.press('x');
  await known(session);
  expect(await page.evaluate(() => window.teeter.paused)).toBe(true);
  expect(session.complaints).toEqual([]);
});

test.each([
  [360, 740],
  [390, 844],
])('at %i px by %i px no control covers the tower or runs over the edge of another', async (width, height) => {
  await using session = await Session.open(chrome, `${SMALL}&render=once`, { viewport: { width, height } });
  const { page } = session;
  await page.click('#xray-toggle');
  await known(session);
  const problems = await page.evaluate(() => {
    const { teeter } = window;
    const box = (id: string) => document.getElementById(id)!.getBoundingClientRect();
    const problems: string[] = [];
    const tools = box('tools');
    for (const button of document.querySelectorAll<HTMLElement>('#tools button')) {
      const { left, right } = button.getBoundingClientRect();
      const inside = button.scrollWidth <= button.clientWidth && left >= tools.left && right <= tools.right;
      if (!inside) problems.push(button.textContent!.trim());
    }
    for (let body = 0; body < teeter.count; body++) {
      for (const [i, j, k] of [0, 1, 2, 3, 4, 5, 6, 7].map(n => [n & 1, (n >> 1) & 1, n >> 2].map(bit => bit - 0.5))) {
        const at = teeter.screenOf(body, [
          i * teeter.sizes[3 * body],
          j * teeter.sizes[3 * body + 1],
          k * teeter.sizes[3 * body + 2],
        ]);
        for (const id of ['switches', 'xray', 'tools', 'title']) {
          const { left, right, top, bottom } = box(id);
          if (at.x > left && at.x < right && at.y > top && at.y < bottom) problems.push(`${id} covers block ${body}`);
        }
      }
    }
    return problems;
  });
  expect(problems).toEqual([]);
  expect(session.complaints).toEqual([]);
});
