// Files of the repository, as git lists them: tracked, or new and not ignored.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const ROOT = join(dirname(fileURLToPath(import.meta.url)), '../..');

/** Returns the paths of all files, relative to the root and sorted. */
export function listFiles() {
  const options = { cwd: ROOT, encoding: 'utf8', maxBuffer: 1 << 26 };
  const listed = execFileSync('git', ['ls-files', '-z', '--cached', '--others', '--exclude-standard'], options);
  return [...new Set(listed.split('\0'))].filter(path => path && existsSync(join(ROOT, path))).sort();
}

/** Returns the text of a file. */
export const read = path => readFileSync(join(ROOT, path), 'utf8');

/** Returns the room of a path: `crates/physics`, `web`, `docs`, or the root. */
export function room(path) {
  const parts = path.split('/');
  if (parts.length === 1) return '(root)';
  return ['crates', 'benches'].includes(parts[0]) && parts.length > 2 ? `${parts[0]}/${parts[1]}` : parts[0];
}
