// How fast the page runs here: figures, no bounds. Drawing is held to one small picture a second,
// for it is done in software.

import { expect, test } from 'vitest';
import { host, Session, SMALL, SPRUNG } from '../page/browser';

test.each([
  ['rigid blocks', SMALL],
  ['springs inside', SPRUNG],
])('the full tower, awake, %s', async (blocks, address) => {
  const chrome = await host();
  try {
    await using session = await Session.open(chrome, `${address}&sleep=0&render=once`);
    await session.simulate(12);
    const figures = await session.page.evaluate(async () => {
      const { awake, factor, capacity, longest } = window.teeter;
      return { awake, factor, capacity, longest, ...(await window.teeter.hash()) };
    });
    expect(figures.awake).toBe(54);
    console.log(blocks);
    console.log(`simulated seconds per second                     ${figures.factor.toFixed(3)}`);
    console.log(`simulated seconds per second of stepping         ${figures.capacity.toFixed(2)}`);
    console.log(`longest hold of the page by a message of physics ${figures.longest.physics.toFixed(1)} ms`);
    console.log(`state at ${figures.time.toFixed(2)} s: ${figures.hash}`);
  } finally {
    await chrome.stop();
  }
});
