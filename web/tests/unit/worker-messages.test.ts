// The engine's worker takes any message: it carries it out or answers why not, and goes on.

import { readFile } from 'node:fs/promises';
import fc from 'fast-check';
import { beforeAll, expect, test } from 'vitest';
import { readMessage } from '../../src/engine/message-reader';
import type { FromWorker, ToWorker } from '../../src/engine/protocol';
import { anything, body, command, damaged, ENGINES, form, isReadBy, real, watched } from './arbitraries';
import { WorkerHost } from './worker-host';

const WORLD = 1;
const RECORD = new URL('../../../data/golden/contest.record', import.meta.url);
/** Seed of the messages: those of a run can be had again. */
const SEED = Number(process.env.SEED ?? 1);

const host = new WorkerHost<FromWorker>();
let record: Uint8Array;
let questions = 0;

beforeAll(async () => {
  record = Uint8Array.from(await readFile(RECORD));
  await host.start(() => import('../../src/engine/worker'));
  host.take();
}, 120_000);

/** Hash of the state: undefined before the first world. */
function hash(): string | undefined {
  const id = (questions += 1);
  host.post({ type: 'ask', id, question: { what: 'hash' } });
  const answer = host.take().find(message => message.type === 'answer' && message.id === id);
  expect(answer, 'the worker answers').toBeDefined();
  return ((answer as { value: unknown }).value as { hash: string } | null)?.hash;
}

const setup = {
  source: { kind: 'tower', rows: 3, seed: 1, block: 'official' },
  sleep: true,
  stiffness: 3e5,
  form: 'rigid',
  springs: null,
  rules: null,
  computers: [],
};

const source = fc.oneof(
  fc.record({
    kind: fc.constant('tower'),
    rows: fc.integer({ min: -1, max: 4 }),
    seed: fc.nat(),
    block: fc.constantFrom('dissertation', 'official'),
  }),
  fc.record({ kind: fc.constant('named'), name: fc.oneof(fc.constant('block'), fc.string()) }),
  fc.record({ kind: fc.constant('scene'), text: fc.oneof(fc.string(), fc.json()) }),
  fc.record({ kind: fc.constant('record'), bytes: fc.uint8Array() }),
  fc.record({
    kind: fc.constant('replay'),
    bytes: fc.uint8Array(),
    engines: fc.constant(ENGINES),
  }),
);
const question = fc.oneof(
  fc.constantFrom('hash', 'world', 'move', 'xray').map(what => ({ what })),
  fc.record({ what: fc.constant('contacts'), body }),
  fc.record({ what: fc.constant('hashes'), until: fc.double({ min: -1, max: 1, noNaN: true }) }),
  fc.record({ what: fc.constant('record'), state: fc.boolean() }),
);
const rules = fc.record({
  table: fc.constantFrom('free', 'official', 'strict', 'friendly', 'dissertation', 'solo', 'throw-and-go'),
  players: fc.nat(9),
  first: fc.nat(9),
  die: fc.nat(),
});
const built = fc.record({
  source,
  sleep: fc.boolean(),
  stiffness: fc.oneof(fc.constant(3e5), real),
  form,
  springs: fc.option(real),
  rules: fc.option(rules),
  computers: fc.array(
    fc.record({ player: fc.nat(9), strength: fc.constantFrom('random', 'expert', 'x'), seed: fc.nat() }),
    { maxLength: 2 },
  ),
});
const world = fc.constantFrom(WORLD, WORLD, WORLD, 0);
/** Messages as the page sends them, with any values. */
const valid = fc.oneof(
  { weight: 1, arbitrary: fc.record({ type: fc.constant('build'), world: fc.constant(WORLD), setup: built }) },
  { weight: 8, arbitrary: fc.record({ type: fc.constant('command'), world, number: fc.nat(), command }) },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('pause'), paused: fc.boolean() }) },
  {
    weight: 1,
    arbitrary: fc.record({ type: fc.constant('speed'), speed: fc.double({ min: 1e-3, max: 1e3, noNaN: true }) }),
  },
  { weight: 1, arbitrary: fc.record({ type: fc.constant('watch'), watched }) },
  { weight: 1, arbitrary: fc.record({ type: fc.constant('seek'), world, frame: fc.nat() }) },
  {
    weight: 1,
    arbitrary: fc.record({
      type: fc.constant('decided'),
      world,
      player: fc.nat(9),
      considered: fc.oneof(fc.string(), fc.json()),
    }),
  },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('ask'), id: fc.constant(0), question }) },
);
/** Posts a message and checks the answer: the worker goes on, and an error changes nothing. */
function check(data: unknown): void {
  const before = hash();
  host.post(data);
  const sent = host.take();
  expect(sent.filter(({ type }) => type === 'failed')).toEqual([]);
  const errors = sent.filter(({ type }) => type === 'invalid');
  if (isReadBy(readMessage, data)) expect(errors.length).toBeLessThanOrEqual(1);
  else
    expect(sent).toEqual([
      { type: 'invalid', id: expect.toSatisfy(id => id === null || id === 0), message: expect.any(String) },
    ]);
  for (const error of errors) expect((error as { message: string }).message).not.toMatch(/\n|^$/);
  if (errors.length > 0) expect(hash()).toBe(before);
}

/** Waits until the worker has stepped more than `count` times: it goes on. */
async function stepThrough(count: number): Promise<void> {
  host.post({ type: 'pause', paused: false });
  host.post({ type: 'speed', speed: 1000 });
  let frames = 0;
  while (frames <= count) {
    await new Promise(resolve => setTimeout(resolve));
    const types = host.take().map(({ type }) => type);
    expect(types).not.toContain('failed');
    frames += types.filter(type => type === 'frame').length;
  }
}

async function checkAll(messages: fc.Arbitrary<unknown>, numRuns: number): Promise<void> {
  await fc.assert(
    fc.asyncProperty(fc.array(messages, { minLength: 1, maxLength: 30 }), async list => {
      host.post({ type: 'build', world: WORLD, setup });
      list.forEach(check);
      await stepThrough(list.length);
      expect(hash()).toMatch(/^[0-9a-f]{16}$/);
    }),
    { numRuns, seed: SEED, endOnFailure: false },
  );
}

test('messages of the page with any values leave the worker running', () => checkAll(valid, 30), 600_000);
test('messages with damaged parts leave the worker running', () => checkAll(damaged(valid, anything, 4), 40), 600_000);
test('values that are no messages are answered by an error', () => checkAll(anything, 10), 600_000);

test('every message of the page can be read', () => {
  fc.assert(
    fc.property(valid, message => {
      expect(isReadBy(readMessage, message)).toBe(true);
    }),
    { numRuns: 2000, seed: SEED },
  );
});

test('an error names the field and the question', () => {
  const errorOf = (data: unknown) => {
    host.post(data);
    return host.take().find(({ type }) => type === 'invalid');
  };
  const ask = { type: 'ask', id: 7, question: { what: 'contacts', body: -1 } };
  expect(errorOf(ask)).toEqual({ type: 'invalid', id: 7, message: 'question.body: expected >=0' });
  const far = { ...ask, question: { what: 'contacts', body: 4000 } };
  expect(errorOf(far)).toEqual({ type: 'invalid', id: 7, message: expect.stringContaining('4000') });
  expect(errorOf(null)).toEqual({ type: 'invalid', id: null, message: 'the message: expected Object' });
  const grasp = { command: 'grasp', body: 1, anchor: [0, NaN, 0], normal: [0, 0, 1], grip: 'auto' };
  expect(errorOf({ type: 'command', world: WORLD, number: 1, command: grasp })).toEqual({
    type: 'invalid',
    id: null,
    message: 'command.anchor.1: expected number',
  });
});

test('a damaged record is refused, and the previous game goes on', async () => {
  host.post({ type: 'build', world: WORLD, setup });
  host.post({ type: 'pause', paused: true });
  const kinds = fc.constantFrom('record', 'replay');
  await fc.assert(
    fc.asyncProperty(fc.nat(), fc.integer({ min: 1, max: 255 }), kinds, async (at, xor, kind) => {
      const bytes = record.slice();
      bytes[at % bytes.length] ^= xor;
      const before = hash();
      const source = { kind, bytes, engines: ENGINES };
      host.post({ type: 'build', world: WORLD + 1, setup: { ...setup, source } } as ToWorker);
      // The engine of a replay may have to be fetched.
      await new Promise(resolve => setTimeout(resolve));
      const types = host.take().map(({ type }) => type);
      expect(types).toContain('refused');
      expect(types).not.toContain('failed');
      expect(hash()).toBe(before);
    }),
    { numRuns: 100, seed: SEED },
  );
}, 600_000);
