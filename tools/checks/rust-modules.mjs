// Light parser of Rust modules: which file declares what, and which files a file imports from.
//
// It follows `mod`, `use` and paths, through re-exports to the file that defines an item. Methods
// are not followed: a call on a value imports nothing. Code under `#[cfg(test)]` is left out.
import { dirname, join } from 'node:path';
import { codeOnly } from './lex.mjs';

const ITEM = /\b(?:fn|struct|enum|union|trait|type|const|static|macro_rules!)\s+(?:mut\s+)?([A-Za-z_]\w*)/g;

/** Index after the bracket that closes the one at `open`. */
function closing(code, open) {
  const pairs = { '{': '}', '[': ']', '(': ')' };
  const [from, to] = [code[open], pairs[code[open]]];
  let depth = 0;
  for (let i = open; i < code.length; i += 1) {
    if (code[i] === from) depth += 1;
    else if (code[i] === to && (depth -= 1) === 0) return i + 1;
  }
  return code.length;
}

/** Removes each item under `#[cfg(test)]`, with its block or up to its semicolon. */
export function withoutTests(code) {
  let out = code;
  for (let at = out.search(/#\[cfg\(test\)\]/); at >= 0; at = out.search(/#\[cfg\(test\)\]/)) {
    const open = /[{;]/g;
    open.lastIndex = at;
    const found = open.exec(out);
    const end = !found ? out.length : found[0] === ';' ? found.index + 1 : closing(out, found.index);
    out = out.slice(0, at) + out.slice(at, end).replace(/[^\n]/g, ' ') + out.slice(end);
  }
  return out;
}

/** Splits at commas outside of braces. */
function splitList(text) {
  const parts = [''];
  let depth = 0;
  for (const char of text) {
    if (char === '{') depth += 1;
    if (char === '}') depth -= 1;
    if (char === ',' && depth === 0) parts.push('');
    else parts[parts.length - 1] += char;
  }
  return parts.map(part => part.trim()).filter(Boolean);
}

/** Expands a tree of `use` to `{ path, name }`; the name of a glob is `*`. */
export function expandUse(tree) {
  const text = tree.trim();
  const brace = text.indexOf('{');
  if (brace >= 0) {
    const prefix = text
      .slice(0, brace)
      .replace(/::\s*$/, '')
      .split('::')
      .map(part => part.trim())
      .filter(Boolean);
    return splitList(text.slice(brace + 1, text.lastIndexOf('}'))).flatMap(part =>
      expandUse(part).map(({ path, name }) => ({
        path: path.at(-1) === 'self' && path.length === 1 ? prefix : [...prefix, ...path],
        name: name === 'self' ? prefix.at(-1) : name,
      })),
    );
  }
  const [source, alias] = text.split(/\s+as\s+/);
  const path = source
    .split('::')
    .map(part => part.trim())
    .filter(Boolean);
  if (path.at(-1) === '*') return [{ path: path.slice(0, -1), name: '*' }];
  return [{ path, name: alias?.trim() ?? path.at(-1) }];
}

/** Cuts inline modules out of a code: `[[name, body], ...]` and the rest. */
function inlineModules(code) {
  const modules = [];
  let rest = code;
  for (let found = /\bmod\s+(\w+)\s*\{/.exec(rest); found; found = /\bmod\s+(\w+)\s*\{/.exec(rest)) {
    const open = found.index + found[0].length - 1;
    const end = closing(rest, open);
    modules.push([found[1], rest.slice(open + 1, end - 1)]);
    rest = rest.slice(0, found.index) + rest.slice(found.index, end).replace(/[^\n]/g, ' ') + rest.slice(end);
  }
  return { modules, rest };
}

function parseModule(module, source, readFile) {
  const { modules, rest } = inlineModules(source);
  module.items = new Set([...rest.matchAll(ITEM)].map(([, name]) => name));
  module.uses = [];
  module.code = rest.replace(/(\bpub(?:\s*\([^)]*\))?\s+)?\buse\s+([^;]+);/g, (whole, pub, tree) => {
    for (const one of expandUse(tree)) module.uses.push({ ...one, pub: Boolean(pub) });
    return ' ';
  });
  for (const [name, body] of modules) {
    const child = { name, parent: module, file: module.file, folder: join(module.folder, name), children: new Map() };
    module.children.set(name, child);
    parseModule(child, body, readFile);
  }
  for (const [, name] of module.code.matchAll(/\bmod\s+(\w+)\s*;/g)) {
    const path = [join(module.folder, `${name}.rs`), join(module.folder, name, 'mod.rs')].find(
      p => readFile(p) !== null,
    );
    if (!path) continue;
    const child = { name, parent: module, file: path, folder: join(module.folder, name), children: new Map() };
    module.children.set(name, child);
    parseModule(child, withoutTests(codeOnly(readFile(path), 'rust')), readFile);
  }
  module.code = module.code.replace(/\bmod\s+\w+\s*;/g, ' ');
}

/**
 * Returns the tree of modules of the crate whose root is at `path`; `readFile` returns null for
 * what is missing.
 */
export function parseCrate(path, readFile) {
  const root = { name: 'crate', parent: null, file: path, folder: dirname(path), children: new Map() };
  parseModule(root, withoutTests(codeOnly(readFile(path), 'rust')), readFile);
  return root;
}

const rootOf = module => (module.parent ? rootOf(module.parent) : module);
const all = module => [module, ...[...module.children.values()].flatMap(all)];

/** Start of a path: the module it begins in and the segments left, or null for another crate. */
function start(module, path) {
  let [at, rest] = [module, path];
  if (rest[0] === 'crate' || rest[0] === '$crate') return [rootOf(module), rest.slice(1)];
  if (rest[0] === 'self') rest = rest.slice(1);
  else if (rest[0] !== 'super') {
    return module.children.has(rest[0]) || module.items.has(rest[0]) ? [module, rest] : null;
  }
  while (rest[0] === 'super' && at.parent) [at, rest] = [at.parent, rest.slice(1)];
  return [at, rest];
}

/**
 * Resolves segments from a module: `{ module }` or `{ file }` of the item, or null where it leaves
 * the crate.
 */
function walk(module, path, seen = new Set()) {
  if (path.length === 0) return { module };
  const [name, ...rest] = path;
  const key = `${module.file} ${module.folder} ${path.join('::')}`;
  if (seen.has(key)) return null;
  seen.add(key);
  if (module.children.has(name)) return walk(module.children.get(name), rest, seen);
  if (module.items.has(name)) return { file: module.file };
  const named = module.uses.find(use => use.name === name);
  if (named) {
    const from = start(module, named.path);
    return from && walk(from[0], [...from[1], ...rest], seen);
  }
  for (const use of module.uses.filter(use => use.name === '*')) {
    const from = start(module, use.path);
    const glob = from && walk(from[0], from[1], seen);
    const found = glob?.module && walk(glob.module, path, seen);
    if (found) return found;
  }
  return null;
}

/** Names that a glob import of a module brings. */
function exported(module, seen = new Set()) {
  if (seen.has(module)) return [];
  seen.add(module);
  const names = [...module.items, ...module.children.keys()];
  for (const use of module.uses) {
    if (use.name !== '*') names.push(use.name);
    else {
      const from = start(module, use.path);
      const glob = from && walk(from[0], from[1]);
      if (glob?.module) names.push(...exported(glob.module, seen));
    }
  }
  return names;
}

function resolve(module, path) {
  const from = start(module, path);
  return from && walk(from[0], from[1]);
}

/** Files that one module imports from. */
function importsOf(module) {
  const files = new Set();
  const add = found => found && files.add(found.file ?? found.module.file);
  const mentions = name => new RegExp(`(?<![\\w:])${name}\\b`).test(module.code);
  const scope = new Map();
  for (const use of module.uses) {
    const found = resolve(module, use.path);
    if (!found) continue;
    if (use.name === '*' && found.module) {
      for (const name of exported(found.module)) {
        if (/^\w+$/.test(name) && mentions(name)) add(walk(found.module, [name]));
      }
    } else if (found.module) scope.set(use.name, found.module);
    // What is only handed on is no import: a child may use what its parent defines.
    else if (!use.pub || mentions(use.name)) add(found);
  }
  for (const [path] of module.code.matchAll(/(?<![\w:])(?:\$?[A-Za-z_]\w*)(?:\s*::\s*[A-Za-z_]\w*)+/g)) {
    const [first, ...rest] = path.split('::').map(part => part.trim());
    const imported = scope.get(first);
    add(imported ? (walk(imported, rest) ?? { module: imported }) : resolve(module, [first, ...rest]));
  }
  // A macro of the crate is called by its name alone.
  for (const [, name] of module.code.matchAll(/(?<![\w:])([a-z_]\w*)!/g)) {
    const owner = all(rootOf(module)).find(
      m => m.items.has(name) && new RegExp(`macro_rules!\\s+${name}\\b`).test(m.code),
    );
    if (owner) add({ file: owner.file });
  }
  return files;
}

/** Returns `file -> files it imports from` of a crate. */
export function importGraph(root) {
  const graph = new Map();
  for (const module of all(root)) {
    const files = graph.get(module.file) ?? new Set();
    for (const file of importsOf(module)) if (file !== module.file) files.add(file);
    graph.set(module.file, files);
  }
  return graph;
}
