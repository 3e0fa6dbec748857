// A worker of the page in this process. Its messages are cloned as between threads, and it loads
// the engine from disk.

import { readFile } from 'node:fs/promises';
import { vi } from 'vitest';

const WASM = new URL('../../src/wasm/', import.meta.url);

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
