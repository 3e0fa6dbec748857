// Fails if source files import each other, directly or in a longer circle. Imports of types count.

import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), 'src');
const files = new Set(
  readdirSync(root, { recursive: true })
    .map(name => join(root, name))
    .filter(path => path.endsWith('.ts') && !path.endsWith('.d.ts')),
);

/** Returns the source files that a file imports. */
function importsOf(file) {
  const names = readFileSync(file, 'utf8').matchAll(/^(?:import|export)\b[^;]*?from '(\.[^']*)'/gm);
  const paths = [...names].map(([, name]) => resolve(dirname(file), name));
  return paths.flatMap(path => [`${path}.ts`, join(path, 'index.ts')].filter(candidate => files.has(candidate)));
}

const graph = new Map([...files].map(file => [file, importsOf(file)]));
const finished = new Set();
const circles = [];

/** Visits the imports of a file, to which `path` leads. */
function visit(file, path) {
  const at = path.indexOf(file);
  if (at >= 0) circles.push([...path.slice(at), file]);
  if (at >= 0 || finished.has(file)) return;
  for (const next of graph.get(file)) visit(next, [...path, file]);
  finished.add(file);
}

for (const file of files) visit(file, []);
for (const circle of circles) console.error(`circle: ${circle.map(file => relative(root, file)).join(' -> ')}`);
if (circles.length > 0) process.exit(1);
console.log(`${files.size} files, no circles`);
