// Memory of the page after ten games: figures, no bounds.

import { afterAll, beforeAll, test } from 'vitest';
import { host, Session, SMALL, type Host } from '../page/browser';

const GAMES = 10;

let chrome: Host;
beforeAll(async () => {
  chrome = await host();
});
afterAll(() => chrome?.stop());

test('ten games, one after the other', async () => {
  await using session = await Session.open(chrome, `${SMALL}&mode=hot-seat&render=once`);
  const { page } = session;
  const tools = await page.context().newCDPSession(page);
  await tools.send('Performance.enable');
  const heap = async () => {
    await tools.send('HeapProfiler.collectGarbage');
    const { metrics } = await tools.send('Performance.getMetrics');
    return metrics.find(({ name }) => name === 'JSHeapUsedSize')!.value / 1e6;
  };
  /** Memory of the page with its workers, their engines included, MB. */
  const whole = () =>
    page.evaluate(async () => {
      const measured = performance as unknown as { measureUserAgentSpecificMemory(): Promise<{ bytes: number }> };
      return (await measured.measureUserAgentSpecificMemory()).bytes / 1e6;
    });
  const figures = async () => `heap ${(await heap()).toFixed(1)} MB, with workers ${(await whole()).toFixed(1)} MB`;
  console.log(`after the first game  ${await figures()}`);
  for (let game = 1; game < GAMES; game++) {
    await session.rebuild(() => page.click('#reset'));
    await session.simulate(2);
  }
  console.log(`after ten games       ${await figures()}`);
}, 600_000);
