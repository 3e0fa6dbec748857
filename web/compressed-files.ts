// A step of the build: writes files beside those of the page, compressed for browsers that take it.

import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';
import type { Plugin } from 'vite';

/** Ending of the compressed form of a file, as servers expect it. */
export const COMPRESSED = '.br';

/** Returns the content compressed by Brotli, as small as it gets. */
const compress = (content: Uint8Array): Buffer =>
  brotliCompressSync(content, {
    params: {
      [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY,
      [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS,
      [constants.BROTLI_PARAM_SIZE_HINT]: content.length,
    },
  });

/** Compresses each file of a new build that gets smaller by it. Pictures already are. */
export function compressedFiles(folder: string): Plugin {
  return {
    name: 'compressed-files',
    apply: 'build',
    enforce: 'post',
    closeBundle() {
      for (const entry of readdirSync(folder, { recursive: true, withFileTypes: true })) {
        const path = join(entry.parentPath, entry.name);
        if (!entry.isFile() || /\.(png|webp|jpg)$/.test(path)) continue;
        const plain = readFileSync(path);
        const small = compress(plain);
        if (small.length < plain.length) writeFileSync(path + COMPRESSED, small);
      }
    },
  };
}
