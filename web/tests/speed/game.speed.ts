// How the page of a game runs here: figures, and the bounds that do not depend on the machine.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { host, Session, SMALL, type Host } from '../page/browser';
import { phase, takeOut } from '../page/hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

declare global {
  interface Window {
    /** Tasks over 50 ms, ms. */
    held: { startTime: number; duration: number }[];
  }
}

/** Notes how long each task held the thread of the page. */
const watchTasks = () => {
  window.held = [];
  new PerformanceObserver(list => {
    window.held.push(...list.getEntries().map(({ startTime, duration }) => ({ startTime, duration })));
  }).observe({ type: 'longtask', buffered: true });
};

test('the page can be used after it was opened', async () => {
  await using session = await Session.open(chrome, SMALL, { before: page => page.addInitScript(watchTasks) });
  const seconds = await session.page.evaluate(() => performance.now() / 1000);
  console.log(`from the address to a standing tower that can be pulled  ${seconds.toFixed(2)} s`);
});

test('a turn with the sound on', async () => {
  await using session = await Session.open(chrome, `${SMALL}&mode=hot-seat&render=once&sleep=0`, {
    before: page => page.addInitScript(watchTasks),
  });
  const { page } = session;
  await page.keyboard.press('m');
  const start = await page.evaluate(() => ({ at: performance.now(), time: window.teeter.time }));
  await takeOut(session, 49);
  await phase(session, 'choosing', 2);
  await session.simulate(5);
  const figures = await page.evaluate(({ at, time }) => {
    const { capacity, longest } = window.teeter;
    const held = window.held.filter(({ startTime }) => startTime >= at).map(({ duration }) => duration);
    const factor = (window.teeter.time - time) / ((performance.now() - at) / 1000);
    return { capacity, longest, factor, held: held.sort((a, b) => b - a) };
  }, start);
  console.log(`simulated seconds per second                             ${figures.factor.toFixed(3)}`);
  console.log(`simulated seconds per second of stepping                 ${figures.capacity.toFixed(2)}`);
  console.log(`longest hold of the page by a message of physics         ${figures.longest.physics.toFixed(1)} ms`);
  console.log(`tasks over 50 ms, drawing included                       ${figures.held.length}`);
  console.log(`longest of them                                          ${(figures.held[0] ?? 0).toFixed(0)} ms`);
});

test('ten games need no more memory than one', async () => {
  await using session = await Session.open(chrome, `${SMALL}&mode=hot-seat&render=once`);
  const { page } = session;
  /** Memory of the page, its workers and the engines in them, MiB. */
  const memory = () =>
    page.evaluate(async () => {
      const measured = await (
        performance as unknown as { measureUserAgentSpecificMemory(): Promise<{ bytes: number }> }
      ).measureUserAgentSpecificMemory();
      return measured.bytes / 2 ** 20;
    });
  const sizes: number[] = [];
  for (let game = 0; game < 10; game++) {
    await phase(session, 'choosing', 1);
    await takeOut(session, 49);
    await phase(session, 'choosing', 2);
    await page.click('#menu-open');
    await page.click('#menu-resign');
    await page.waitForSelector('#end[open]');
    sizes.push(await memory());
    await session.rebuild(() => page.click('#end-again'));
  }
  console.log(`memory of the page and its workers after each game, MiB  ${sizes.map(s => s.toFixed(0)).join(' ')}`);
  expect(Math.max(...sizes)).toBeLessThan(512);
}, 600_000);
