// The engine that a record is replayed by: that of this page, or the kept one that wrote it. Bits
// may differ from engine to engine, so each release keeps its own (tools/keep-engine).

/** Part of an engine that a replay uses. */
export type Engine = Pick<
  typeof import('../wasm/teeter_wasm.js'),
  'Replay' | 'Keyframes' | 'engineId' | 'recordEngine'
>;

/** An engine, and the memory that its poses are read from. */
export interface LoadedEngine {
  engine: Engine;
  memory: WebAssembly.Memory;
}

type Glue = Engine & Pick<typeof import('../wasm/teeter_wasm.js'), 'default'>;

/** Reads a file; null where there is none. */
export type Read = (url: URL) => Promise<Uint8Array<ArrayBuffer> | null>;

/** Identity of an engine: its version, and a hash of its golden results. */
const IDENTITY = /^\d+\.\d+\.\d+\+[0-9a-f]{16}$/;
/** Beginning of a module. */
const MAGIC = [0x00, 0x61, 0x73, 0x6d];

/**
 * Finds the engine of a record: `own` where it wrote the record, else the kept one below `base`.
 * Null where that is missing: the keyframes of `own` show such a record. Throws an Error whose
 * message is for the user where the bytes are no record.
 */
export async function engineOf(
  record: Uint8Array,
  own: LoadedEngine,
  base: URL,
  read: Read = fetched,
): Promise<LoadedEngine | null> {
  const id = own.engine.recordEngine(record);
  if (id === own.engine.engineId()) return own;
  // Part of an address: a record from anywhere names nothing but an engine.
  if (!IDENTITY.test(id)) return null;
  const folder = new URL(`${id.replace('+', '-')}/`, base);
  const module_or_path = await read(new URL('teeter_wasm_bg.wasm', folder));
  // Some servers send a page where a file is missing.
  if (!module_or_path || !MAGIC.every((byte, index) => module_or_path[index] === byte)) return null;
  const glue = (await import(/* @vite-ignore */ new URL('teeter_wasm.js', folder).href)) as Glue;
  const { memory } = await glue.default({ module_or_path });
  return { engine: glue, memory };
}

async function fetched(url: URL): Promise<Uint8Array<ArrayBuffer> | null> {
  const response = await fetch(url);
  return response.ok ? new Uint8Array(await response.arrayBuffer()) : null;
}
