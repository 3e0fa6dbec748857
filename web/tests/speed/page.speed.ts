// How fast the page runs here: figures, no verdict. Drawing is held to one small picture a second,
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
    const told = await session.page.evaluate(async () => {
      const { awake, factor, capacity, longest } = window.teeter;
      return { awake, factor, capacity, longest, ...(await window.teeter.hash()) };
    });
    expect(told.awake).toBe(54);
    console.log(blocks);
    console.log(`simulated seconds per second                     ${told.factor.toFixed(3)}`);
    console.log(`simulated seconds per second of stepping         ${told.capacity.toFixed(2)}`);
    console.log(`longest hold of the page by a message of physics ${told.longest.physics.toFixed(1)} ms`);
    console.log(`state at ${told.time.toFixed(2)} s: ${told.hash}`);
  } finally {
    await chrome.stop();
  }
});
