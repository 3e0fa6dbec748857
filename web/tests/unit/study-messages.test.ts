// A worker that studies takes any message: each job ends with a result or an error, and the next
// one begins.

import { readFile } from 'node:fs/promises';
import fc from 'fast-check';
import { beforeAll, expect, test } from 'vitest';
import type { Setup } from '../../src/engine/protocol';
import type { FromStudy } from '../../src/study/jobs';
import { readStudyMessage } from '../../src/study/job-reader';
import { Game, towerScene } from '../../src/wasm/teeter_wasm.js';
import { anything, damaged, ENGINES, isReadBy } from './arbitraries';
import { WorkerHost } from './worker-host';

const RECORD = new URL('../../../data/golden/contest.record', import.meta.url);
/** Seed of the messages: those of a run can be had again. */
const SEED = Number(process.env.SEED ?? 1);
/** Ids of the jobs that are checked by their result. */
const CHECKED = 1_000_000;

/** Setup of the tower of a day. */
const SETUP: Setup = {
  source: { kind: 'tower', rows: 3, seed: 1, block: 'official' },
  sleep: true,
  stiffness: 1e6,
  form: 'rigid',
  springs: null,
  rules: { table: 'solo', players: 1 },
  computers: [],
};

const host = new WorkerHost<FromStudy>();
let record: Uint8Array;
let state: Uint8Array;
let checks = 0;

beforeAll(async () => {
  record = Uint8Array.from(await readFile(RECORD));
  await host.start(() => import('../../src/study/study-worker'));
  // The queue begins when the engine is loaded, which a first error waits for.
  const job = { kind: 'verify', seconds: 1, bytes: new Uint8Array(), engines: ENGINES, setup: SETUP };
  host.post({ type: 'run', id: 0, job });
  expect(await endOf(0)).toEqual({ type: 'failed', id: 0, message: expect.any(String) });
  const game = new Game(towerScene('{"rows": 3}'), '');
  state = game.world();
  game.free();
}, 120_000);

/** The message that ends a job. */
async function endOf(id: number): Promise<FromStudy> {
  for (;;) {
    const end = host.take().find(message => message.id === id && message.type !== 'progress');
    if (end) return end;
    await new Promise(resolve => setTimeout(resolve));
  }
}

/** Checks that the worker carries out a job after all those before. */
async function checkNext(): Promise<void> {
  const id = CHECKED + (checks += 1);
  host.post({ type: 'run', id, job: { kind: 'tower', seconds: 0, state, rules: '', budget: 1 } });
  expect((await endOf(id)).type).toBe('result');
}

const seconds = fc.double({ min: 0, max: 0.01, noNaN: true });
const bytes = fc.oneof(
  fc.uint8Array(),
  fc.tuple(fc.nat(), fc.nat(255)).map(([at, value]) => {
    const copy = record.slice();
    copy[at % copy.length] = value;
    return copy;
  }),
);
const worldBytes = fc.oneof(
  fc.uint8Array(),
  fc.constant(null).map(() => state),
  fc.tuple(fc.nat(), fc.nat(255)).map(([at, value]) => {
    const copy = state.slice();
    copy[at % copy.length] = value;
    return copy;
  }),
);
const text = fc.oneof(fc.string(), fc.json(), fc.constant('{"player": 0, "seed": 1, "strength": "expert"}'));
const budget = fc.nat(20);
const command = fc.constantFrom({ command: 'idle' }, { command: 'poke' }, { command: 'resign' });
const rules = fc.record({
  table: fc.constantFrom('free', 'official', 'solo'),
  players: fc.nat(9),
  first: fc.nat(9),
  turn_s: fc.option(fc.double({ noNaN: true, min: -1, max: 100 })),
  settle_s: fc.double({ noNaN: true, min: -1, max: 100 }),
  max_force: fc.double({ noNaN: true, min: -1, max: 100 }),
  points: fc.option(fc.record({ block: fc.nat(9), row: fc.nat(9) })),
});
const move = fc.record({
  scene: fc.oneof(
    fc.constant(null).map(() => towerScene('{"rows": 2}')),
    fc.json(),
  ),
  rules,
  commands: fc.array(command, { maxLength: 3 }),
  fell: fc.boolean(),
  placed: fc.boolean(),
});
const job = fc.oneof(
  fc.record({ kind: fc.constant('think'), seconds, state: worldBytes, question: text }),
  fc.record({ kind: fc.constant('tower'), seconds, state: worldBytes, rules: text, budget }),
  fc.record({ kind: fc.constant('record'), seconds, bytes, budget }),
  fc.record({ kind: fc.constant('verify'), seconds, bytes, engines: fc.constant(ENGINES), setup: fc.constant(SETUP) }),
  fc.record({ kind: fc.constant('cut'), seconds, move }),
);
const id = fc.nat(CHECKED);
/** Messages as the page sends them, with any values. */
const valid = fc.oneof(
  { weight: 5, arbitrary: fc.record({ type: fc.constant('run'), id, job }) },
  { weight: 1, arbitrary: fc.record({ type: fc.constant('stop'), id }) },
);

/** Posts messages; those that are none are answered by an error, and the worker goes on. */
async function checkAll(messages: fc.Arbitrary<unknown>, numRuns: number): Promise<void> {
  await fc.assert(
    fc.asyncProperty(fc.array(messages, { minLength: 1, maxLength: 10 }), async list => {
      for (const data of list) {
        host.post(data);
        if (isReadBy(readStudyMessage, data)) continue;
        const last = host.take().pop();
        expect(last?.type).toBe('failed');
        expect((last as { message: string }).message).not.toMatch(/\n|^$/);
      }
      await checkNext();
    }),
    { numRuns, seed: SEED },
  );
}

test('jobs with any values leave the worker running', () => checkAll(valid, 30), 600_000);
test('jobs with damaged parts leave the worker running', () => checkAll(damaged(valid, anything, 3), 40), 600_000);
test('values that are no jobs are answered by an error', () => checkAll(anything, 40), 600_000);

test('an error names the field and the job', () => {
  const errorOf = (data: unknown) => {
    host.take();
    host.post(data);
    return host.take();
  };
  expect(errorOf({ type: 'run', id: 3, job: { kind: 'verify', seconds: NaN, bytes: record } })).toEqual([
    { type: 'failed', id: 3, message: 'job.seconds: expected number' },
  ]);
  expect(errorOf(undefined)).toEqual([{ type: 'failed', id: null, message: 'the message: expected Object' }]);
});
