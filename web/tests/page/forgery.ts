// Forged records: their content is changed, and their length and checksum are those of the change.

import { deflateRawSync, inflateRawSync } from 'node:zlib';
import { xxhash3 } from 'hash-wasm';
import { load } from '../engine.mjs';

/** Bytes of the mark and the version, of the length, and of the checksum. */
const HEADER = { mark: 14, length: 4, checksum: 8 };

/** Byte of the content from which it is changed: past the names of the engine and the scene. */
const FIRST = 120;

/** Returns a record that can be read, and that says of some frame what was not. */
export async function forged(record: Uint8Array): Promise<Uint8Array> {
  const { Replay } = await load('simd128');
  const start = HEADER.mark + HEADER.length + HEADER.checksum;
  const content = inflateRawSync(record.subarray(start));
  for (let at = FIRST; at < content.length; at += 1) {
    const changed = Buffer.from(content);
    changed[at] ^= 1;
    const bytes = await sealed(record.subarray(0, HEADER.mark), changed);
    if (!isTrue(() => new Replay(bytes))) return bytes;
  }
  throw new Error('no change of a byte leaves a record that can be read');
}

/** Returns a record that says it was written by another engine, of a name of the same length. */
export async function renamed(record: Uint8Array, engine: string): Promise<Uint8Array> {
  const { recordEngine } = await load('simd128');
  const start = HEADER.mark + HEADER.length + HEADER.checksum;
  const content = inflateRawSync(record.subarray(start));
  const own = recordEngine(record);
  const at = content.indexOf(own);
  if (at < 0 || own.length !== engine.length) throw new Error(`${own} cannot become ${engine}`);
  content.write(engine, at, 'latin1');
  return sealed(record.subarray(0, HEADER.mark), content);
}

/** True for a record that replays the same, and for bytes that are none. */
function isTrue(open: () => { step(): string | undefined; isSame: boolean; free(): void }): boolean {
  try {
    const replay = open();
    while (replay.step() !== undefined);
    const { isSame } = replay;
    replay.free();
    return isSame;
  } catch {
    return true;
  }
}

async function sealed(mark: Uint8Array, content: Buffer): Promise<Uint8Array> {
  const compressed = deflateRawSync(content);
  const length = Buffer.alloc(HEADER.length);
  length.writeUInt32LE(compressed.length);
  const checksum = Buffer.from(await xxhash3(compressed), 'hex').reverse();
  return Buffer.concat([mark, length, checksum, compressed]);
}
