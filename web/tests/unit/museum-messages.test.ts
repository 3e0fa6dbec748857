// The museum's worker of the tower takes any message: it carries it out or answers why not, and
// goes on.

import fc from 'fast-check';
import { beforeAll, expect, test } from 'vitest';
import { readToMuseum } from '../../src/museum/message-reader';
import type { MuseumFrame } from '../../src/museum/protocol';
import type { FromWorker } from '../../src/engine/protocol';
import { anything, command, damaged, isReadBy, real, vec, watched } from './arbitraries';
import { WorkerHost } from './worker-host';

const WORLD = 1;
/** Seed of the messages: those of a run can be had again. */
const SEED = Number(process.env.SEED ?? 1);

const host = new WorkerHost<FromWorker | MuseumFrame>();

beforeAll(async () => {
  await host.start(() => import('../../src/museum/tower-worker'));
  host.take();
}, 120_000);

const setup = { show: 'both', scene: null, rows: 2, seed: 1, constants: {} };

const unit = fc.constantFrom([0, 0, 1], [1, 0, 0], [0, -1, 0]);
const pointer = fc.record({ origin: vec, direction: fc.oneof(unit, vec), toward_viewer: fc.oneof(unit, vec) });
const request = fc.oneof(
  fc.record({ request: fc.constantFrom('pick', 'drag', 'resume'), pointer }),
  fc.record({ request: fc.constant('pull'), distance: real, toward_viewer: fc.oneof(unit, vec) }),
  fc.constant({ request: 'release' }),
);
const names = fc.oneof(fc.constantFrom('stiffness', 'friction', 'gravity', 'hand', 'disabling'), fc.string());
const values = fc.oneof(fc.constantFrom('0', '1e3', '-1', 'NaN', 'off', 'force'), fc.string());
const constants = fc.dictionary(names, values, { maxKeys: 3 });
const question = fc.oneof(
  fc.record({ what: fc.constant('contacts'), body: fc.nat(20) }),
  fc.constantFrom('constants', 'hash', 'xray').map(what => ({ what })),
  fc.record({ what: fc.constant('set'), values: constants }),
);
const world = fc.constantFrom(WORLD, WORLD, WORLD, 0);
/** Messages as the page sends them, with any values. */
const valid = fc.oneof(
  {
    weight: 1,
    arbitrary: fc.record({
      type: fc.constant('build'),
      world: fc.constant(WORLD),
      setup: fc.record({
        show: fc.constantFrom('old', 'engine', 'both'),
        scene: fc.option(fc.oneof(fc.constant('block'), fc.string())),
        rows: fc.integer({ min: -1, max: 3 }),
        seed: fc.nat(),
        constants,
      }),
    }),
  },
  { weight: 8, arbitrary: fc.record({ type: fc.constant('command'), world, number: fc.nat(), command }) },
  { weight: 8, arbitrary: fc.record({ type: fc.constant('request'), world, request }) },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('pause'), paused: fc.boolean() }) },
  { weight: 1, arbitrary: fc.record({ type: fc.constant('watch'), watched }) },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('ask'), id: fc.constant(0), question }) },
);

/** Posts a message and checks that the worker answers as it should. */
function check(data: unknown): void {
  host.post(data);
  const sent = host.take();
  expect(sent.filter(({ type }) => type === 'failed')).toEqual([]);
  const errors = sent.filter(({ type }) => type === 'invalid');
  if (isReadBy(readToMuseum, data)) expect(errors.length).toBeLessThanOrEqual(1);
  else expect(sent).toEqual([{ type: 'invalid', id: expect.toSatisfy(isNone), message: expect.any(String) }]);
  for (const error of errors) expect((error as { message: string }).message).not.toMatch(/\n|^$/);
}

/** True for the id of a message that is no question, or of the questions here. */
const isNone = (id: unknown) => id === null || id === 0;

/** Waits until the worker has stepped more than `count` times, each with a command: it goes on. */
async function stepThrough(count: number): Promise<void> {
  host.post({ type: 'pause', paused: false });
  let frames = 0;
  while (frames <= count) {
    await new Promise(resolve => setTimeout(resolve, 5));
    const types = host.take().map(({ type }) => type);
    expect(types).not.toContain('failed');
    frames += types.filter(type => type === 'frame').length;
  }
}

async function checkAll(messages: fc.Arbitrary<unknown>, numRuns: number): Promise<void> {
  await fc.assert(
    fc.asyncProperty(fc.array(messages, { minLength: 1, maxLength: 8 }), async list => {
      host.post({ type: 'build', world: WORLD, setup });
      host.take();
      list.forEach(check);
      await stepThrough(list.length);
    }),
    { numRuns, seed: SEED, endOnFailure: false },
  );
}

test('messages of the museum with any values leave the worker running', () => checkAll(valid, 50), 600_000);
test('messages with damaged parts leave the worker running', () => checkAll(damaged(valid, anything, 4), 60), 600_000);
test('values that are no messages are answered by an error', () => checkAll(anything, 10), 600_000);

test('every message of the museum can be read', () => {
  fc.assert(
    fc.property(valid, message => {
      expect(isReadBy(readToMuseum, message)).toBe(true);
    }),
    { numRuns: 1000, seed: SEED },
  );
});

test('a request that the hand of 2003 refuses names its fault, and the tower goes on', async () => {
  host.post({ type: 'build', world: WORLD, setup });
  host.take();
  const pointer = { origin: [0, 0, 1], direction: [0, 0, 0], toward_viewer: [0, 0, 1] };
  host.post({ type: 'request', world: WORLD, request: { request: 'pick', pointer } });
  const refusal = { type: 'invalid', id: null, message: expect.stringContaining('a direction has no length') };
  expect(host.take()).toEqual([refusal]);
  host.post({ type: 'request', world: WORLD, request: { request: 'pull', distance: NaN, toward_viewer: [0, 0, 1] } });
  expect(host.take()).toEqual([{ type: 'invalid', id: null, message: 'request.distance: expected number' }]);
  await stepThrough(1);
});
