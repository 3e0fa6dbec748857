// The layout of the page at the sizes of phones and desktops, in each language.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { host, Session, SMALL, type Host } from './browser';
import { findProblems, wide } from './layout';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

test.each([
  [390, 844, 'en'],
  [360, 640, 'en'],
  [844, 390, 'en'],
  [1280, 800, 'en'],
  [390, 844, 'de'],
  [844, 390, 'de'],
  [1280, 800, 'de'],
])('at %i x %i in %s nothing overlaps, is cut off or leaves the screen', async (width, height, lang) => {
  const phone = width < 1000;
  await using session = await Session.open(chrome, `${SMALL}&lang=${lang}`, {
    viewport: { width, height },
    hasTouch: phone,
    isMobile: phone,
  });
  const { page } = session;
  const problems = (carrying = false) => findProblems(page, carrying);
  expect(await problems()).toEqual([]);
  await page.click('#menu-open');
  await page.click('[data-mode="hot-seat"]');
  await page.click('#match-add');
  expect(await problems(), 'in the menu').toEqual([]);
  await session.rebuild(() => page.click('#match-start'));
  await page.waitForSelector('#turn:not([hidden])');
  expect(await problems(), 'in a game with turns').toEqual([]);
  await page.click('#menu-open');
  await page.click('[data-mode="free"]');
  await session.rebuild(() => page.click('#match-start'));
  await page.click('#settings');
  expect(await problems()).toEqual([]);
  await page.selectOption('#form', 'lattice');
  await page.waitForSelector('#springs-fields:not([hidden])');
  expect(await problems(), 'with the dial of the springs').toEqual([]);
  expect(await wide(page, '#panel'), 'in the settings').toEqual([]);
  await page.click('#gallery-open');
  await page.waitForSelector('#gallery img');
  expect(await wide(page, '#gallery'), 'in the gallery').toEqual([]);
  await page.click('#gallery-close');
  await page.click('#help-open');
  for (const summary of await page.locator('#help summary').all()) await summary.click();
  expect(await wide(page, '#help'), 'in the help').toEqual([]);
  await page.click('#help-close');
  await page.click('#panel-close');
  await page.click('#springs-toggle');
  await page.waitForSelector('#scale:not([hidden])');
  expect(await problems(), 'with the legend of the springs').toEqual([]);
  expect(await problems(true), 'with a block in the hand').toEqual([]);
  await page.click('#xray-toggle');
  await page.waitForFunction(() => window.teeter.xray.pulls !== null);
  expect(await problems(true), 'with the legend of the X-ray').toEqual([]);
});

test('a German browser gets German texts and figures, and the setting changes the language for good', async () => {
  await using session = await Session.open(chrome, `${SMALL}&rows=3&render=once`, { locale: 'de-CH' });
  const { page } = session;
  const state = () =>
    page.evaluate(() => ({
      lang: document.documentElement.lang,
      pause: document.querySelector('#pause span')!.textContent,
      tip: document.getElementById('place')!.title,
      force: document.getElementById('cap-value')!.textContent,
    }));
  expect(await state()).toEqual({
    lang: 'de',
    pause: 'Pause',
    tip: 'Den freien Klotz obenauf legen (P)',
    force: '4,0 N',
  });
  await page.waitForFunction(() =>
    /^(Steht|In Bewegung) · 9 Klötze$/.test(document.getElementById('state')!.textContent!),
  );
  await page.click('#settings');
  await Promise.all([page.waitForNavigation(), page.selectOption('#language', 'en')]);
  await page.waitForFunction(() => window.teeter?.ready);
  const english = { lang: 'en', pause: 'Pause', tip: 'Place the free block on top (P)', force: '4.0 N' };
  expect(await state()).toEqual(english);
  await page.reload();
  await page.waitForFunction(() => window.teeter?.ready);
  expect(await state()).toEqual(english);
  expect(session.complaints).toEqual([]);
});
