// The worker of an exhibit in the plane takes any message: it carries it out or answers why not,
// and goes on.

import fc from 'fast-check';
import { beforeAll, expect, test } from 'vitest';
import { readToPlane } from '../../src/museum/message-reader';
import type { FromPlane } from '../../src/museum/protocol';
import { anything, damaged, isReadBy } from './arbitraries';
import { WorkerHost } from './worker-host';

/** Seed of the messages: those of a run can be had again. */
const SEED = Number(process.env.SEED ?? 1);

const host = new WorkerHost<FromPlane>();

beforeAll(async () => {
  await host.start(() => import('../../src/museum/plane-worker'));
  host.post({ type: 'build', scene: 0, setup });
  // The module may still load: messages wait for it.
  await stepOn();
}, 120_000);

const setup = { method: 'constraint', setting: 'stack', count: 2, gap: 0, stiffness: null };

const near = fc.oneof(
  fc.double({ min: -0.1, max: 0.1, noNaN: true }),
  fc.double({ min: -1000, max: 1000, noNaN: true }),
);
const position = { x: near, y: near };
/** Messages as the page sends them, with any values. */
const valid = fc.oneof(
  {
    weight: 1,
    arbitrary: fc.record({
      type: fc.constant('build'),
      scene: fc.nat(),
      setup: fc.record({
        method: fc.constantFrom('springs', 'constraint', 'penalty', 'micro-collisions'),
        setting: fc.constantFrom('stack', 'falling', 'tower'),
        count: fc.nat(5),
        gap: fc.oneof(fc.constant(0.005), near),
        stiffness: fc.option(fc.oneof(fc.constant(1000), near)),
      }),
    }),
  },
  {
    weight: 1,
    arbitrary: fc.record({ type: fc.constant('speed'), speed: fc.double({ min: 0, max: 1000, noNaN: true }) }),
  },
  { weight: 3, arbitrary: fc.constantFrom('single', 'release').map(type => ({ type })) },
  { weight: 3, arbitrary: fc.record({ type: fc.constantFrom('hold', 'drag'), ...position }) },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('add'), ...position, vx: near, vy: near }) },
);

/** Waits until the worker shows another picture: it goes on. */
async function stepOn(): Promise<void> {
  host.post({ type: 'single' });
  for (;;) {
    const types = host.take().map(({ type }) => type);
    expect(types).not.toContain('failed');
    if (types.includes('frame')) return;
    await new Promise(resolve => setTimeout(resolve, 5));
  }
}

/** Posts a message and checks that the worker answers as it should. */
function check(data: unknown): void {
  host.post(data);
  const sent = host.take();
  expect(sent.filter(({ type }) => type === 'failed')).toEqual([]);
  const errors = sent.filter(({ type }) => type === 'invalid');
  expect(errors.length).toBe(isReadBy(readToPlane, data) ? 0 : 1);
  for (const error of errors) expect((error as { message: string }).message).not.toMatch(/\n|^$/);
}

async function checkAll(messages: fc.Arbitrary<unknown>, numRuns: number): Promise<void> {
  await fc.assert(
    fc.asyncProperty(fc.array(messages, { minLength: 1, maxLength: 20 }), async list => {
      host.post({ type: 'build', scene: 1, setup });
      list.forEach(check);
      await stepOn();
      host.post({ type: 'speed', speed: 0 });
    }),
    { numRuns, seed: SEED, endOnFailure: false },
  );
}

test('messages of an exhibit with any values leave the worker running', () => checkAll(valid, 40), 600_000);
test('messages with damaged parts leave the worker running', () => checkAll(damaged(valid, anything, 3), 60), 600_000);
test('values that are no messages are answered by an error', () => checkAll(anything, 10), 600_000);

test('a scene that cannot be built leaves the one that is shown', async () => {
  host.post({ type: 'build', scene: 5, setup });
  host.take();
  host.post({ type: 'build', scene: 6, setup: { ...setup, count: 1000 } });
  expect(host.take()).toEqual([
    { type: 'refused', message: expect.stringContaining('`count` is 1000, expected 1 to') },
  ]);
  host.post({ type: 'single' });
  expect(host.take()).toEqual([expect.objectContaining({ type: 'frame', scene: 5 })]);
});
