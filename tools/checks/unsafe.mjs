// Unsafe code: every block, function and implementation is listed in docs/unsafe.md with its
// reason, and every block has its own comment.
import { listFiles, read } from './files.mjs';

export const LIST = 'docs/unsafe.md';
/** Lines before a block within which its comment stands. */
const REACH = 5;
/** Folder of macros and tables of intrinsics, which have one reason each in their module. */
const REGISTERS = 'crates/physics/src/simd/';

/** Returns the unsafe parts of a Rust source: line (from 1), kind, and whether a reason is near. */
export function unsafeParts(source) {
  const lines = source.split('\n');
  const found = [];
  lines.forEach((text, i) => {
    const code = text.replace(/\/\/.*$/, '').replace(/"(\\.|[^"\\])*"/g, '""');
    for (const [, kind] of code.matchAll(/\bunsafe\s+(?:extern "" )?(fn|impl|extern|\{)/g)) {
      const before = lines.slice(Math.max(0, i - REACH), i).join('\n');
      found.push({ line: i + 1, kind: kind === '{' ? 'block' : kind, reasoned: /SAFETY:|# Safety/.test(before) });
    }
  });
  return found;
}

/** Returns the files of the list with their numbers: `| \`path\` | number | reason |`. */
export function listed(document) {
  const rows = [...document.matchAll(/^\| `([^`]+\.rs)` \| (\d+) \| ([^|]+) \|$/gm)];
  return new Map(rows.map(([, path, count]) => [path, Number(count)]));
}

/** Returns findings about all Rust files. */
export function findings(paths = listFiles(), readFile = read) {
  const list = listed(readFile(LIST));
  const found = [];
  for (const path of paths.filter(path => path.endsWith('.rs'))) {
    const parts = unsafeParts(readFile(path));
    const known = list.get(path) ?? 0;
    if (parts.length !== known) found.push(`${path}: ${parts.length} unsafe parts, ${known} in ${LIST}`);
    list.delete(path);
    for (const { line, kind, reasoned } of parts) {
      if (kind === 'block' && !reasoned && !path.startsWith(REGISTERS))
        found.push(`${path}:${line}: unsafe ${kind} without its reason`);
    }
  }
  return [...found, ...[...list.keys()].map(path => `${LIST}: ${path} is not there`)];
}
