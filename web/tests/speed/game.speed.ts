// How the page of a game runs here: figures, no bounds.

import { afterAll, beforeAll, test } from 'vitest';
import { host, Session, SMALL, type Host } from '../page/browser';
import { phase, takeOut } from '../page/hands';

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

/** Block of the second row that comes out easily. */
const LOOSE = 3;

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
  await using session = await Session.open(chrome, SMALL);
  const seconds = await session.page.evaluate(() => performance.now() / 1000);
  console.log(`from the address to a standing tower that can be pulled  ${seconds.toFixed(2)} s`);
});

test('a turn with the sound on', async () => {
  await using session = await Session.open(chrome, `${SMALL}&mode=hot-seat&sleep=0`, {
    before: page => page.addInitScript(watchTasks),
  });
  const { page } = session;
  const start = await page.evaluate(() => ({ at: performance.now(), time: window.teeter.time }));
  await takeOut(session, LOOSE);
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
}, 300_000);
