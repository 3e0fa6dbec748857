// Finds files of a crate that import each other, directly or in a longer circle, and prints each
// circle as a chain.
import { listFiles, read, room } from './files.mjs';
import { importGraph, parseCrate } from './rust-modules.mjs';

/** Returns the shortest circle through a file, or null. */
function circleThrough(graph, start) {
  const from = new Map([[start, null]]);
  for (const file of from.keys()) {
    for (const next of [...(graph.get(file) ?? [])].sort()) {
      if (next === start) {
        const chain = [start];
        for (let at = file; at !== null; at = from.get(at)) chain.push(at);
        return chain.reverse();
      }
      if (!from.has(next)) from.set(next, file);
    }
  }
  return null;
}

/**
 * Returns the circles of a graph: for each file in one, the shortest through it; each circle once.
 */
export function findCircles(graph) {
  const found = new Map();
  for (const file of [...graph.keys()].sort()) {
    const chain = circleThrough(graph, file);
    if (!chain) continue;
    const key = [...new Set(chain)].sort().join(' ');
    if (!found.has(key)) found.set(key, chain);
  }
  return [...found.values()];
}

/** Number of groups of circles that share a file. */
export function groups(circles) {
  const sets = [];
  for (const chain of circles) {
    const joined = new Set(chain);
    for (let i = sets.length - 1; i >= 0; i -= 1) {
      if (![...sets[i]].some(file => joined.has(file))) continue;
      for (const file of sets.splice(i, 1)[0]) joined.add(file);
    }
    sets.push(joined);
  }
  return sets.length;
}

const ROOT_FILE =
  /^(.*\/)?(src\/(lib|main)\.rs|src\/bin\/[^/]+\.rs|src\/bin\/[^/]+\/main\.rs|(tests|benches|examples)\/[^/]+\.rs)$/;

function main() {
  const files = listFiles().filter(path => path.endsWith('.rs'));
  const known = new Set(files);
  const readFile = path => (known.has(path) ? read(path) : null);
  const rooms = new Map();
  const seen = new Map();
  for (const path of files.filter(path => ROOT_FILE.test(path))) {
    for (const chain of findCircles(importGraph(parseCrate(path, readFile)))) {
      const key = [...new Set(chain)].sort().join(' ');
      if (seen.has(key)) continue;
      seen.set(key, chain);
      rooms.set(room(path), (rooms.get(room(path)) ?? 0) + 1);
      console.log(`circle: ${chain.join('\n     -> ')}`);
    }
  }
  for (const [name, count] of rooms) console.log(`  ${String(count).padStart(5)}  ${name}`);
  const count = `${seen.size} in ${groups([...seen.values()])} groups`;
  console.log(`circles: ${seen.size ? count : 0}, of ${files.length} Rust files`);
  return seen.size === 0;
}

if (process.argv[1] === new URL(import.meta.url).pathname) process.exitCode = main() ? 0 : 1;
