// A worker of the page in this process. Its messages are cloned as between threads, and it loads
// the engine from disk.

import { readFile } from 'node:fs/promises';
import fc from 'fast-check';
import { vi } from 'vitest';

const WASM = new URL('../../src/wasm/', import.meta.url);

/** Address of kept engines, of which there are none. */
export const ENGINES = 'http://127.0.0.1:9/engines/';

export class WorkerHost<FromWorker> {
  /** Messages of the worker since they were last taken. */
  private sent: FromWorker[] = [];
  private readonly scope = {
    onmessage: null as ((event: { data: unknown }) => void) | null,
    postMessage: (message: FromWorker) => void this.sent.push(structuredClone(message)),
    setTimeout: globalThis.setTimeout,
  };

  /** Starts the worker whose module `load` imports; it listens from then on. */
  async start(load: () => Promise<unknown>): Promise<void> {
    vi.stubGlobal('self', this.scope);
    vi.stubGlobal('fetch', async (url: URL) => {
      const bytes = await readFile(new URL(url.pathname.split('/').pop()!, WASM));
      return new Response(bytes, { headers: { 'Content-Type': 'application/wasm' } });
    });
    await load();
    await vi.waitUntil(() => this.scope.onmessage !== null, { timeout: 60_000 });
  }

  /** Hands a message to the worker, as an event of its queue. Throws what nothing in it catches. */
  post(data: unknown): void {
    this.scope.onmessage!({ data: structuredClone(data) });
  }

  /** Takes the messages that the worker has sent. */
  take(): FromWorker[] {
    return this.sent.splice(0);
  }
}

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
export const isCloneable = (value: unknown): boolean => succeeds(() => structuredClone(value));

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
