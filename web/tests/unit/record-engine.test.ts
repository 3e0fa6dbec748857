// A record opens with the engine that wrote it, also where the page has another one by now.

import { execFileSync } from 'node:child_process';
import { mkdir, mkdtemp, readdir, readFile, rm, stat, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { engineOf, type LoadedEngine, type Read } from '../../src/engine/record-engine';
import { engineFiles } from '../../kept-engines';
import load, * as engine from '../../src/wasm/teeter_wasm.js';

const root = new URL('../../../', import.meta.url);
const read: Read = async url => {
  try {
    return Uint8Array.from(await readFile(url));
  } catch {
    return null;
  }
};

let folder: string, base: URL, record: Uint8Array, own: LoadedEngine, later: LoadedEngine;
beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), 'engines-'));
  base = pathToFileURL(`${folder}/`);
  const kept = join(folder, 'kept');
  execFileSync(fileURLToPath(new URL('tools/keep-engine', root)), [kept]);
  // As the build of the page unpacks them.
  for (const { name, content } of engineFiles(kept)) {
    await mkdir(join(folder, dirname(name)), { recursive: true });
    await writeFile(join(folder, name), content);
  }
  record = await readFile(new URL('data/golden/contest.record', root));
  const bytes = await readFile(new URL('web/src/wasm/teeter_wasm_bg.wasm', root));
  const { memory } = await load({ module_or_path: bytes });
  own = { engine, memory };
  later = { engine: { ...engine, engineId: () => '9.0.0+0000000000000000' }, memory };
}, 600_000);
afterAll(() => rm(folder, { recursive: true }));

test('the engine of the page replays its own records', async () => {
  expect(await engineOf(record, own, base, read)).toBe(own);
});

test('a record of an earlier engine is replayed by the kept one, bit for bit', async () => {
  const kept = await engineOf(record, later, base, read);
  expect(kept!.engine.engineId()).toBe(engine.engineId());
  expect(kept!.memory).not.toBe(own.memory);
  const replay = new kept!.engine.Replay(record);
  while (!replay.seek(replay.frames, 600));
  expect(replay.isSame).toBe(true);
  const top = new Float64Array(kept!.memory.buffer, replay.posesPtr(), 7 * replay.length);
  expect([...top].every(Number.isFinite)).toBe(true);
}, 600_000);

test('a kept engine is below 512 kB', async () => {
  const kept = join(folder, 'kept');
  const names = (await readdir(kept, { recursive: true })).filter(name => /\.(js|br)$/.test(name));
  expect(names).toHaveLength(2);
  for (const name of names) expect((await stat(join(kept, name))).size, name).toBeLessThan(512_000);
});

test('where the engine is missing the keyframes show the record', async () => {
  expect(await engineOf(record, later, new URL('nowhere/', base), read)).toBeNull();
  const page: Read = async () => new TextEncoder().encode('<!doctype html>');
  expect(await engineOf(record, later, base, page)).toBeNull();
  const keyframes = new later.engine.Keyframes(record);
  expect(keyframes.poses(1).length).toBe(7 * keyframes.length);
});

test('an identity that is no identity is no address', async () => {
  const asked: string[] = [];
  const spy: Read = async url => (asked.push(url.href), null);
  for (const id of ['../../x', 'http://x/', '0.1.0+', '0.1.0+DC25AB065AEB8A14']) {
    const odd = { ...later, engine: { ...later.engine, recordEngine: () => id } };
    expect(await engineOf(record, odd, base, spy)).toBeNull();
  }
  expect(asked).toEqual([]);
});

test('bytes that are no record are refused', async () => {
  await expect(engineOf(new Uint8Array([1, 2, 3]), own, base, read)).rejects.toThrow(/no record/);
});
