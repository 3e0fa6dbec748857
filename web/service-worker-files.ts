// A step of the build: names the files of the page in its service worker.

import { createHash } from 'node:crypto';
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import type { Plugin } from 'vite';
import { ENGINES } from './kept-engines.ts';

/** Name of the service worker, which must be the same in each version. */
export const SERVICE_WORKER = 'service-worker.js';

/**
 * Fills in the files of the page and the version, a hash of all of them. A plugin for precaching
 * would bring over three hundred packages for these lines.
 */
export function serviceWorkerFiles(publicFolder: string): Plugin {
  return {
    name: 'service-worker-files',
    apply: 'build',
    enforce: 'post',
    generateBundle: {
      order: 'post',
      handler(_, bundle) {
        const worker = bundle[SERVICE_WORKER];
        if (worker?.type !== 'chunk') throw new Error(`${SERVICE_WORKER} is not in the build`);
        const others = readdirSync(publicFolder, { recursive: true, withFileTypes: true })
          .filter(entry => entry.isFile())
          .map(entry => relative(publicFolder, join(entry.parentPath, entry.name)));
        const made = Object.keys(bundle).filter(name => name !== SERVICE_WORKER && !name.startsWith(ENGINES));
        const files = [...made, ...others].sort();
        const hash = createHash('sha256').update(worker.code);
        for (const name of files) {
          const made = bundle[name];
          hash
            .update(name)
            .update(made ? (made.type === 'chunk' ? made.code : made.source) : readFileSync(`${publicFolder}/${name}`));
        }
        worker.code = worker.code
          .replace('__FILES__', JSON.stringify(JSON.stringify(files)).slice(1, -1))
          .replace('__VERSION__', hash.digest('hex').slice(0, 16));
      },
    },
  };
}
