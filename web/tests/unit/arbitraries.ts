// Arbitrary messages to the workers of the page, whole and damaged.

import fc from 'fast-check';

/** Address of kept engines, of which there are none. */
export const ENGINES = 'http://127.0.0.1:9/engines/';

/** True where an action does not throw. */
function succeeds(action: () => unknown): boolean {
  try {
    action();
    return true;
  } catch {
    return false;
  }
}

/** True for a value that can be in a message between threads. */
const isCloneable = (value: unknown): boolean => succeeds(() => structuredClone(value));

/** True for a message that `read` takes: it may still be refused by the engine. */
export const isReadBy = (read: (data: unknown) => unknown, data: unknown): boolean =>
  succeeds(() => read(structuredClone(data)));

/** Messages with a part, at most `depth` steps into them, that is missing or another value. */
export function damaged(messages: fc.Arbitrary<unknown>, values: fc.Arbitrary<unknown>, depth: number) {
  const steps = fc.array(fc.nat(20), { minLength: 1, maxLength: depth });
  return fc
    .tuple(messages, steps, fc.option(fc.record({ value: values })))
    .map(([message, steps, to]) => changed(message, steps, to));
}

/**
 * Copy of a value with one part changed, or left out for null. Each step into it is a number, taken
 * modulo the number of fields.
 */
function changed(value: unknown, steps: readonly number[], to: { value: unknown } | null): unknown {
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value) || steps.length === 0) return to?.value;
  const copy = (Array.isArray(value) ? [...value] : { ...value }) as Record<string, unknown>;
  const keys = Object.keys(copy);
  if (keys.length === 0) return to?.value;
  const key = keys[steps[0] % keys.length];
  if (steps.length === 1 && to === null) delete copy[key];
  else copy[key] = changed(copy[key], steps.slice(1), to);
  return copy;
}

/** Finite numbers, small ones as often as any. */
export const real = fc.oneof(
  fc.double({ min: -1, max: 1, noNaN: true }),
  fc.double({ min: -1e12, max: 1e12, noNaN: true }),
);
export const vec = fc.tuple(real, real, real);
/** Blocks that exist and that do not. */
export const body = fc.oneof(fc.nat(12), fc.nat());
const slot = fc.option(fc.record({ row: fc.nat(9), cell: fc.nat(9) }));
export const form = fc.constantFrom('rigid', 'lattice');
/** Commands of the game with any values. */
export const command = fc.oneof(
  fc.constantFrom('idle', 'poke', 'release', 'resign').map(name => ({ command: name })),
  fc.record({
    command: fc.constant('grasp'),
    body,
    anchor: vec,
    normal: vec,
    grip: fc.constantFrom('auto', 'slide', 'carry', 'push'),
  }),
  fc.record({
    command: fc.constant('move'),
    displacement: vec,
    slot,
    toward_viewer: fc.option(fc.tuple(real, real)),
  }),
  fc.record({ command: fc.constant('turn'), rotation: fc.tuple(real, real, real, real) }),
  fc.record({ command: fc.constant('place'), body: fc.option(body), slot }),
  fc.record({ command: fc.constant('set_hand'), max_force: real, careful: fc.boolean(), can_turn: fc.boolean() }),
  fc.record({ command: fc.constant('set_blocks'), form, spring_stiffness: fc.option(real) }),
);

/** Values of any form that can be in a message. */
export const anything = fc
  .anything({
    withDate: true,
    withMap: true,
    withSet: true,
    withTypedArray: true,
    withSparseArray: true,
    withBigInt: true,
  })
  .filter(isCloneable);

/** Parts that a page watches. */
export const watched = fc.record({
  springs: fc.boolean(),
  xray: fc.boolean(),
  sound: fc.boolean(),
  selected: fc.option(body),
});
