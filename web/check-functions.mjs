// Fails if a function of the source does not fit a screen, or takes too many parameters.

import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseSync } from 'vite';

const MAX_LINES = 60;
const MAX_PARAMETERS = 5;

const root = resolve(dirname(fileURLToPath(import.meta.url)), 'src');
const files = readdirSync(root, { recursive: true })
  .map(name => join(root, name))
  .filter(path => path.endsWith('.ts') && !path.endsWith('.d.ts'));

/** Yields all functions of a syntax tree. */
function* functionsOf(node) {
  if (node === null || typeof node !== 'object') return;
  if (node.params && node.body) yield node;
  for (const child of Object.values(node)) yield* functionsOf(child);
}

const problems = [];
let count = 0;
for (const file of files) {
  const text = readFileSync(file, 'utf8');
  const lineOf = offset => text.slice(0, offset).split('\n').length;
  for (const { start, end, params } of functionsOf(parseSync(file, text).program)) {
    count += 1;
    const line = lineOf(start);
    const lines = lineOf(end) - line + 1;
    const at = `${relative(root, file)}:${line}`;
    if (lines > MAX_LINES) problems.push(`${at}: function of ${lines} lines, at most ${MAX_LINES}`);
    if (params.length > MAX_PARAMETERS) problems.push(`${at}: ${params.length} parameters, at most ${MAX_PARAMETERS}`);
  }
}

for (const problem of problems) console.error(problem);
if (problems.length > 0) process.exit(1);
console.log(`${count} functions, none too long`);
