// The pages for everybody: axe-core finds nothing, by light and dark, in every dialog and view; the
// focus has an order; and a system that asks for less motion or more contrast gets it.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { findings } from './axe';
import { host, Session, SMALL, type Host } from './browser';
import { drawOut, phase, takeOut } from './hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

test.each(['light', 'dark'] as const)('axe-core finds nothing on the page by %s', async colorScheme => {
  await using session = await Session.open(chrome, 'quality=low&scale=0.2&form=lattice&rows=4&render=once', {
    colorScheme,
  });
  const { page } = session;
  await page.waitForSelector('#coach:not([hidden])');
  expect(await findings(page), 'in the first minute').toEqual([]);
  await page.click('#coach-close');
  await page.keyboard.press('h');
  await page.waitForSelector('#help[open]');
  for (const summary of await page.locator('#help summary').all()) await summary.click();
  expect(await findings(page), 'in the help').toEqual([]);
  await page.click('#help-close');
  expect(await findings(page), 'in play').toEqual([]);
  await page.click('#menu-open');
  for (const mode of ['hot-seat', 'opponent', 'daily', 'solo', 'practice', 'free']) {
    await page.click(`[data-mode="${mode}"]`);
    expect(await findings(page), `in the menu at ${mode}`).toEqual([]);
  }
  await page.click('[data-mode="hot-seat"]');
  await session.rebuild(() => page.click('#match-start'));
  await page.waitForSelector('#turn:not([hidden])');
  expect(await findings(page), 'in a game with turns').toEqual([]);
  await page.keyboard.press('g');
  await page.click('#menu-resign');
  await page.waitForSelector('#end[open]');
  expect(await findings(page), 'at the end of a game').toEqual([]);
  await page.click('#end-other');
  await page.click('[data-mode="free"]');
  await session.rebuild(() => page.click('#match-start'));
  await page.click('#settings');
  expect(await findings(page), 'in the settings').toEqual([]);
  await page.click('#gallery-open');
  await page.waitForFunction(() => document.querySelectorAll('#gallery img').length === 12);
  expect(await findings(page), 'in the gallery').toEqual([]);
  await page.click('#gallery-close');
  await page.click('#panel-close');
  await page.click('#springs-toggle');
  await page.waitForSelector('#scale:not([hidden])');
  expect(await findings(page), 'with the springs').toEqual([]);
  await page.click('#xray-toggle');
  await page.waitForFunction(() => window.teeter.xray.pulls !== null);
  expect(await findings(page), 'with the X-ray').toEqual([]);
  await page.focus('#picture');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.teeter.hand !== null);
  expect(await findings(page), 'with a block in the hand').toEqual([]);
});

test.each(['light', 'dark'] as const)('axe-core finds nothing in the museum by %s', async colorScheme => {
  await using session = await Session.open(chrome, 'quality=low&scale=0.2&rows=3&render=once', {
    colorScheme,
    path: 'museum.html',
    ready: false,
  });
  const { page } = session;
  await page.waitForFunction(() => window.museum?.tower?.ready);
  await page.click('#constants summary');
  expect(await findings(page)).toEqual([]);
});

test('axe-core finds nothing in the menu, in a game and at its end, by light and dark', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&seed=1`);
  const { page } = session;
  const both = async (part: string) => {
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      expect(await findings(page), `${part} by ${colorScheme}`).toEqual([]);
    }
  };
  await page.click('#menu-open');
  for (const mode of ['opponent', 'hot-seat']) {
    await page.click(`[data-mode="${mode}"]`);
    await both(`in the menu, ${mode}`);
  }
  await session.rebuild(() => page.click('#match-start'));
  await phase(session, 'choosing', 1);
  await both('in a game');
  await takeOut(session, 3);
  await phase(session, 'choosing', 2);
  await drawOut(session, 4);
  await page.waitForSelector('#end[open]');
  await page.mouse.up();
  await both('at the end');
});

test('the focus goes through the page in its order, and is seen', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`);
  const { page } = session;
  const order: string[] = [];
  for (let i = 0; i < 12; i++) {
    await page.keyboard.press('Tab');
    const { name, seen } = await page.evaluate(() => {
      const active = document.activeElement as HTMLElement;
      const { outlineStyle, boxShadow } = getComputedStyle(active);
      const name = active.id || active.dataset.grip || active.tagName;
      return { name, seen: outlineStyle !== 'none' || boxShadow !== 'none' };
    });
    expect(seen, `the focus on ${name} is seen`).toBe(true);
    order.push(name);
    if (name === 'settings') break;
  }
  expect(order).toEqual([
    'picture',
    'springs-toggle',
    'xray-toggle',
    'mute',
    'menu-open',
    'auto',
    'pause',
    'reset',
    'settings',
  ]);
});

test('less motion means no transitions, and more contrast no soft text', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`, {
    reducedMotion: 'reduce',
    contrast: 'more',
  });
  const styles = await session.page.evaluate(() => ({
    transition: getComputedStyle(document.getElementById('notice')!).transitionDuration,
    soft: getComputedStyle(document.getElementById('state')!).color,
    ink: getComputedStyle(document.body).color,
  }));
  expect(styles.transition).toBe('0s');
  expect(styles.soft).toBe(styles.ink);
});

test('with forced colours what is chosen and what is pressed is still seen', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`, { forcedColors: 'active' });
  const { page } = session;
  const colours = (selector: string) =>
    page.evaluate(s => {
      const { backgroundColor, color } = getComputedStyle(document.querySelector(s)!);
      return `${backgroundColor} ${color}`;
    }, selector);
  expect(await colours('[data-grip="auto"]')).not.toBe(await colours('[data-grip="slide"]'));
  const before = await colours('#mute');
  await page.click('#mute');
  expect(await colours('#mute')).not.toBe(before);
});
