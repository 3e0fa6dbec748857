// Reads messages to the worker. One of another form is refused before it reaches the engine.

import * as v from 'valibot';
import type { GameCommand } from './game-protocol';
import type { Rules, SceneSource, Setup, ToWorker } from './protocol';

/** Largest number in a message: finite also after it is multiplied and added up. */
const MAX_NUMBER = 1e12;
/** Bounds of simulated time per wall time. */
const SPEED = { min: 1e-3, max: 1e3 };

export const real = v.pipe(v.number(), v.minValue(-MAX_NUMBER), v.maxValue(MAX_NUMBER));
export const index = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(2 ** 32 - 1));
export const bytes = v.instance(Uint8Array);
export const address = v.pipe(v.string(), v.url());
export const vec = v.strictTuple([real, real, real]);
const quat = v.strictTuple([real, real, real, real]);
const slot = v.nullable(v.object({ row: index, cell: index }));
const form = v.picklist(['rigid', 'lattice']);
export const seed = v.pipe(v.number(), v.safeInteger(), v.minValue(0));
const table = v.picklist(['free', 'official', 'strict', 'friendly', 'dissertation', 'solo', 'throw-and-go']);

const grasp = { body: index, anchor: vec, normal: vec, grip: v.picklist(['auto', 'slide', 'carry', 'push']) };
const hand = { max_force: v.optional(real), careful: v.optional(v.boolean()), can_turn: v.optional(v.boolean()) };
const move = { displacement: vec, slot, toward_viewer: v.nullable(v.strictTuple([real, real])) };

export const command: v.GenericSchema<GameCommand> = v.variant('command', [
  v.object({ command: v.literal('idle') }),
  v.object({ command: v.literal('grasp'), ...grasp }),
  v.object({ command: v.literal('move'), ...move }),
  v.object({ command: v.literal('turn'), rotation: quat }),
  v.object({ command: v.literal('place'), body: v.nullable(index), slot }),
  v.object({ command: v.literal('poke') }),
  v.object({ command: v.literal('release') }),
  v.object({ command: v.literal('set_hand'), ...hand }),
  v.object({ command: v.literal('set_blocks'), form, spring_stiffness: v.nullable(real) }),
  v.object({ command: v.literal('resign') }),
]);

/** The engine knows more fields of rules than the page. */
export const rules: v.GenericSchema<Rules> = v.looseObject({
  table,
  players: index,
  first: index,
  turn_s: v.nullable(real),
  settle_s: real,
  max_force: real,
  points: v.nullable(v.object({ block: real, row: real })),
});

const source: v.GenericSchema<SceneSource> = v.variant('kind', [
  v.object({ kind: v.literal('tower'), rows: real, seed, block: v.picklist(['dissertation', 'official']) }),
  v.object({ kind: v.literal('named'), name: v.string() }),
  v.object({ kind: v.literal('scene'), text: v.string() }),
  v.object({ kind: v.literal('record'), bytes }),
  v.object({ kind: v.literal('replay'), bytes, engines: address }),
]);

export const setup: v.GenericSchema<Setup> = v.object({
  source,
  sleep: v.boolean(),
  stiffness: v.nullable(real),
  form: v.nullable(form),
  springs: v.nullable(real),
  rules: v.nullable(v.object({ table, players: index, first: v.optional(index), die: v.optional(seed) })),
  computers: v.array(v.object({ player: index, strength: v.string(), seed })),
});

export const question = v.variant('what', [
  v.object({ what: v.literal('hash') }),
  v.object({ what: v.literal('hashes'), until: real }),
  v.object({ what: v.literal('contacts'), body: index }),
  v.object({ what: v.literal('record'), state: v.boolean() }),
  v.object({ what: v.literal('world') }),
  v.object({ what: v.literal('move') }),
  v.object({ what: v.literal('xray') }),
]);

export const watched = v.object({
  springs: v.boolean(),
  xray: v.boolean(),
  sound: v.boolean(),
  selected: v.nullable(index),
});

const message: v.GenericSchema<ToWorker> = v.variant('type', [
  v.object({ type: v.literal('build'), world: index, setup }),
  v.object({ type: v.literal('command'), world: index, number: index, command }),
  v.object({ type: v.literal('pause'), paused: v.boolean() }),
  v.object({ type: v.literal('speed'), speed: v.pipe(v.number(), v.minValue(SPEED.min), v.maxValue(SPEED.max)) }),
  v.object({ type: v.literal('watch'), watched }),
  v.object({ type: v.literal('seek'), world: index, frame: index }),
  v.object({ type: v.literal('decided'), world: index, player: index, considered: v.string() }),
  v.object({ type: v.literal('ask'), id: index, question }),
]);

/** Reads a value by a schema. Throws an Error that names the field where it is another. */
export function readBy<T>(schema: v.GenericSchema<T>, value: unknown): T {
  const { success, output, issues } = v.safeParse(schema, value, { abortEarly: true });
  if (success) return output;
  const [{ expected, requirement, type }] = issues;
  const path = v.getDotPath(issues[0]) ?? 'the message';
  // The requirement of some is a function: the name of the type says more.
  const wanted = typeof requirement === 'function' ? type : requirement;
  throw new Error(`${path}: expected ${expected ?? String(wanted)}`);
}

/** Reads a message to the worker. Throws an Error that names the field where it is none. */
export function readMessage(data: unknown): ToWorker {
  return readBy(message, data);
}

/** Id of a message that may be a question; null for another. */
export function questionId(data: unknown): number | null {
  const { success, output } = v.safeParse(v.object({ type: v.literal('ask'), id: index }), data);
  return success ? output.id : null;
}
