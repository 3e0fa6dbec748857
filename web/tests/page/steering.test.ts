// The hand without a pointer in a real browser: a move by keys alone, and by a gamepad whose
// trigger gives the force.

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { displacements, host, Session, SMALL, type Host } from './browser';
import { lead } from './hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** Blocks below the top rows whose end is seen, with the load on each, N, the loosest first. */
function ends(page: Page): Promise<{ body: number; load: number }[]> {
  return page.evaluate(async () => {
    const { teeter } = window;
    const found: { body: number; load: number }[] = [];
    for (let body = 6; body < teeter.count - 6; body++) {
      const seen = [1, -1].some(side => {
        const at = teeter.screenOf(body, [(side * teeter.sizes[3 * body]) / 2, 0, 0]);
        return teeter.blockAt(at.x, at.y) === body && at.y > teeter.screenOf(body).y;
      });
      if (!seen) continue;
      const contacts = await teeter.contacts(body);
      found.push({ body, load: contacts.filter(c => c.normal[2] < -0.5).reduce((sum, c) => sum + c.force, 0) });
    }
    return found.sort((a, b) => a.load - b.load);
  });
}

test('a block is chosen, taken out and placed on top with keys alone', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`);
  const { page } = session;
  await session.simulate(1);
  const { body } = (await ends(page))[0];
  const before = await session.poses();
  await page.keyboard.press('Enter');
  expect(await page.textContent('#announcer')).toMatch(/^Block \d+, \d+ mm up$/);
  await lead(page, body, direction => page.keyboard.press(`Arrow${direction}`));
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.teeter.hand !== null);
  await page.keyboard.down('ArrowDown');
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  await page.keyboard.up('ArrowDown');
  await page.waitForFunction(() => document.getElementById('announcer')!.textContent!.includes('out'));
  await page.keyboard.down('ArrowUp');
  await session.simulate(0.4);
  await page.keyboard.up('ArrowUp');
  await page.waitForFunction(() => !(document.getElementById('place') as HTMLButtonElement).disabled);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.getElementById('announcer')!.textContent!.includes('placed'));
  await session.simulate(1);
  const after = await session.poses();
  const top = Math.max(...Array.from({ length: before.length / 7 }, (_, i) => before[7 * i + 2]));
  expect(after[7 * body + 2], 'height of the placed block, m').toBeGreaterThan(top - 1e-3);
  const others = displacements(before, after).filter((_, i) => i !== body);
  expect(Math.max(...others), 'displacement of any other block, m').toBeLessThan(0.01);
  expect(await page.evaluate(() => [window.teeter.state, window.teeter.hand])).toEqual(['standing', null]);
  expect(session.complaints).toEqual([]);
});

test('the trigger of a gamepad pulls with its own force, and its buttons take and let go', async () => {
  await using session = await Session.open(chrome, `${SMALL}&seed=1`, {
    before: page =>
      page.addInitScript(() => {
        const buttons = Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 }));
        const pad = { connected: true, axes: [0, 0, 0, 0], buttons, mapping: 'standard', id: 'pad', index: 0 };
        Object.assign(window, { pad });
        Object.defineProperty(navigator, 'getGamepads', { value: () => [pad] });
      }),
  });
  const { page } = session;
  const set = async (button: number, value: number) => {
    await page.evaluate(
      ([at, to]) => {
        const { pad } = window as unknown as { pad: { buttons: { pressed: boolean; value: number }[] } };
        Object.assign(pad.buttons[at], { pressed: to > 0.5, value: to });
      },
      [button, value],
    );
    // The page reads the gamepad once a picture.
    await page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  };
  const press = async (button: number) => {
    await set(button, 1);
    await set(button, 0);
  };
  await session.simulate(1);
  const { body } = (await ends(page)).at(-1)!;
  const directions: Record<string, number> = { Up: 12, Down: 13, Left: 14, Right: 15 };
  await press(0);
  await lead(page, body, direction => press(directions[direction]));
  await press(0);
  await page.waitForFunction(() => window.teeter.hand !== null);
  const largest = async (value: number) => {
    await set(7, value);
    await session.simulate(1);
    return page.evaluate(() => window.teeter.hand!.force);
  };
  const [weak, strong] = [await largest(0.25), await largest(0.75)];
  expect(weak, 'force of a trigger at 0.25 of 4 N').toBeCloseTo(1, 1);
  expect(strong, 'force of a trigger at 0.75 of 4 N').toBeGreaterThan(1.5);
  expect(strong).toBeLessThan(3.1);
  await press(1);
  expect(await page.evaluate(() => window.teeter.hand)).toBeNull();
  expect(session.complaints).toEqual([]);
});
