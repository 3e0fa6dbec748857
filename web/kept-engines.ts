// A step of the build: adds the engines of earlier releases to the page, for their records.

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { brotliDecompressSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { COMPRESSED } from './compressed-files.ts';

/** Folder of the kept engines in the page. Its files are fetched only where a record needs them. */
export const ENGINES = 'engines/';

/** Files of the kept engines in a folder, as `tools/keep-engine` leaves them, unpacked. */
export function engineFiles(folder: string): { name: string; content: Uint8Array<ArrayBuffer> }[] {
  if (!existsSync(folder)) return [];
  const entries = readdirSync(folder, { recursive: true, withFileTypes: true }).filter(entry => entry.isFile());
  return entries.map(entry => {
    const path = join(entry.parentPath, entry.name);
    const name = relative(folder, path);
    if (!name.endsWith(COMPRESSED)) return { name, content: Uint8Array.from(readFileSync(path)) };
    return {
      name: name.slice(0, -COMPRESSED.length),
      content: Uint8Array.from(brotliDecompressSync(readFileSync(path))),
    };
  });
}

export function keptEngines(folder: string): Plugin {
  return {
    name: 'kept-engines',
    apply: 'build',
    generateBundle() {
      for (const { name, content } of engineFiles(folder))
        this.emitFile({ type: 'asset', fileName: ENGINES + name, source: content });
    },
  };
}
