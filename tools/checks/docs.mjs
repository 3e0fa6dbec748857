// Checks the documents: paths, crates and links that they name exist, the index is whole, and prose
// wraps.
import { posix } from 'node:path';
import { listFiles, read, room } from './files.mjs';
import { language, segments } from './lex.mjs';

const MAX_COLUMNS = 100;
const MAX_LINES = 8;
const INDEX = 'docs/README.md';
const MAP = 'ARCHITECTURE.md';
/** Folders that builds write: named in documents, absent from git. */
const BUILT = [
  'python/teeter/manual',
  'python/teeter/notebook/static',
  'target',
  'web/dist',
  'web/node_modules',
  'web/src/wasm',
  'web/wasm-scalar',
];
const EXTENSION = /\.(rs|ts|mjs|css|html|md|toml|json|jsonl|gz|svg|png|csv|py|yml)$/;

/**
 * Returns the blocks of a document: `{ line, kind, lines }`, kind being prose, table, code, heading
 * or built.
 */
export function blocks(source) {
  const out = [];
  let fence = null;
  let built = false;
  const add = (kind, line, text, open) => {
    const last = out.at(-1);
    if (last && last.kind === kind && last.line + last.lines.length === line && !open) last.lines.push(text);
    else out.push({ line, kind, lines: [text] });
  };
  source.split('\n').forEach((text, i) => {
    const mark = /^\s*(```+|~~~+)/.exec(text)?.[1];
    if (/<!-- (table|generated)\b/.test(text)) built = true;
    if (built) add('built', i + 1, text);
    else if (fence || mark) add('code', i + 1, text);
    else if (/^\s*\|/.test(text)) add('table', i + 1, text);
    else if (/^#+ /.test(text)) add('heading', i + 1, text, true);
    else if (text.trim()) add('prose', i + 1, text, /^\s*([-*+]|\d+\.) /.test(text));
    if (/<!-- end\b/.test(text)) built = false;
    if (mark && (!fence || mark.startsWith(fence))) fence = fence ? null : mark;
  });
  return out;
}

/** True for a line that cannot be broken: one word, link or picture. */
const unbreakable = text =>
  !/\S\s+\S/.test(
    text
      .trim()
      .replace(/^([-*+]|\d+\.|>|\/\/[/!]?|\*|#)\s+/, '')
      .replace(/!?\[[^\]]*\]\([^)]*\)/g, 'x'),
  );

/** Returns what is too long in a document: `{ line, text }`. */
export function longProse(source) {
  const out = [];
  for (const { line, kind, lines } of blocks(source)) {
    if (kind !== 'prose') continue;
    lines.forEach((text, i) => {
      const columns = [...text].length;
      if (columns > MAX_COLUMNS && !unbreakable(text)) out.push({ line: line + i, text: `${columns} columns` });
    });
    if (lines.length > MAX_LINES) out.push({ line, text: `a paragraph of ${lines.length} lines` });
  }
  return out;
}

/** Returns the numbers of the lines between the fences of code examples in doc comments. */
function exampleLines(lines) {
  const inside = new Set();
  let open = false;
  lines.forEach((text, i) => {
    if (/^\s*\/\/[/!]\s*```/.test(text)) open = !open;
    else if (open) inside.add(i + 1);
  });
  return inside;
}

/**
 * Returns the lines of comments that are too long; a comment behind code and an example in a doc
 * comment count as code.
 */
export function longComments(source, lang) {
  const lines = source.split('\n');
  const examples = exampleLines(lines);
  const long = new Set();
  for (const { line, kind, text } of segments(source, lang)) {
    const whole = lines[line - 1];
    if (examples.has(line)) continue;
    if (kind !== 'comment' || whole.trim() !== text.trim() || /^\s*(\/\/[/!]?|\*) *\|/.test(whole)) continue;
    if ([...whole].length > MAX_COLUMNS && !unbreakable(whole)) long.add(line);
  }
  return [...long].map(line => ({ line, text: `comment of ${[...lines[line - 1]].length} columns` }));
}

/** Expands `a/{b,c}` to its paths. */
export function braces(path) {
  const found = /\{([^{}]*)\}/.exec(path);
  if (!found) return [path];
  return found[1].split(',').flatMap(part => braces(path.replace(found[0], part.trim())));
}

/** Returns a test of paths: true for a file or folder, given whole or from a folder on. */
export function pathTest(files) {
  const known = new Set();
  for (const file of files) {
    const parts = file.split('/');
    for (let end = 1; end <= parts.length; end += 1) {
      for (let from = 0; from < end; from += 1) known.add(parts.slice(from, end).join('/'));
    }
  }
  return path => {
    const bare = path.replace(/^\.\//, '').replace(/\/$/, '');
    if (BUILT.some(folder => bare === folder || bare.startsWith(`${folder}/`))) return true;
    if (!bare.includes('*')) return known.has(bare);
    const pattern = new RegExp(`^${bare.replace(/[.+]/g, '\\$&').replace(/\*+/g, '[^/]*')}$`);
    return [...known].some(one => pattern.test(one));
  };
}

/**
 * Returns the paths and crates that a document names in code: `{ line, path }` or `{ line, crate
 * }`.
 */
export function named(source, topFolders, everything) {
  const out = [];
  const isPath = word =>
    /^[\w.*{},/-]+$/.test(word) &&
    !/^[/.]*$/.test(word) &&
    (everything
      ? EXTENSION.test(word) || (/^[a-z][\w.-]+\//.test(word) && !/^[a-z]{1,2}\/[a-z]{1,2}$/.test(word))
      : topFolders.includes(word.split('/')[0]) && word.includes('/'));
  for (const { line, kind, lines } of blocks(source)) {
    lines.forEach((text, i) => {
      const spans = kind === 'code' ? [text] : [...text.matchAll(/`([^`]+)`/g)].map(([, span]) => span);
      if (kind === 'code' && !everything) return;
      for (const word of spans.flatMap(span => span.split(/[\s()]+/))) {
        const bare = word.replace(/[,:;.]+$/, '');
        if (/^teeter(-[a-z0-9]+)+$/.test(bare)) out.push({ line: line + i, crate: bare });
        else if (isPath(bare)) for (const path of braces(bare)) out.push({ line: line + i, path });
      }
    });
  }
  return out;
}

/** Returns the anchor that a heading gets. */
export const slug = heading =>
  heading
    .replace(/^#+ /, '')
    .replace(/\[([^\]]*)\]\([^)]*\)/g, '$1')
    .trim()
    .toLowerCase()
    .replace(/[^\w\- ]/g, '')
    .replace(/ /g, '-');

/**
 * Returns the links of a document to files: `{ line, target, anchor }`, the target relative to the
 * root.
 */
export function links(source, path) {
  const out = [];
  for (const { line, kind, lines } of blocks(source)) {
    if (kind === 'code') continue;
    lines.forEach((text, i) => {
      for (const [, link] of text.replace(/`[^`]*`/g, '').matchAll(/\]\(([^)\s]+)[^)]*\)/g)) {
        if (/^[a-z]+:/.test(link)) continue;
        const [file, anchor] = link.split('#');
        out.push({
          line: line + i,
          target: file ? posix.normalize(posix.join(posix.dirname(path), file)) : path,
          anchor,
        });
      }
    });
  }
  return out;
}

function findLinks(path, source, files) {
  const out = [];
  for (const { line, target, anchor } of links(source, path)) {
    const bare = target.replace(/\/$/, '');
    if (!files.includes(bare) && !files.some(file => file.startsWith(`${bare}/`)))
      out.push({ line, text: `no file ${target}` });
    else if (anchor && bare.endsWith('.md')) {
      const anchors = blocks(read(bare))
        .filter(({ kind }) => kind === 'heading')
        .map(({ lines }) => slug(lines[0]));
      if (!anchors.includes(anchor)) out.push({ line, text: `no heading #${anchor} in ${bare}` });
    }
  }
  return out;
}

function findIndex(files, documents) {
  if (!files.includes(INDEX)) return [{ path: INDEX, line: 1, text: 'the index of the documents is missing' }];
  const targets = path => links(read(path), path).map(({ target }) => target);
  const indexed = targets(INDEX);
  const anywhere = new Set(documents.flatMap(targets));
  return files
    .filter(file => file.startsWith('docs/') && file !== INDEX)
    .filter(file => (file.endsWith('.md') ? !indexed.includes(file) : !anywhere.has(file)))
    .map(file => ({ path: INDEX, line: 1, text: `no link to ${file}` }));
}

function main(args) {
  const countOnly = args.includes('--count');
  const files = listFiles();
  const exists = pathTest(files);
  const documents = files.filter(file => file.endsWith('.md'));
  const topFolders = [...new Set(files.filter(file => file.includes('/')).map(file => file.split('/')[0]))];
  const manifests = files.filter(file => file.endsWith('Cargo.toml')).map(read);
  const crates = new Set(manifests.map(text => /^name = "([^"]+)"/m.exec(text)?.[1]));
  const findings = findIndex(files, documents);
  for (const path of documents) {
    const source = read(path);
    const add = list => findings.push(...list.map(finding => ({ path, ...finding })));
    add(longProse(source));
    add(findLinks(path, source, files));
    for (const { line, path: one, crate } of named(source, topFolders, path === MAP)) {
      if (crate ? !crates.has(crate) : !exists(one)) add([{ line, text: `there is no ${crate ?? one}` }]);
    }
  }
  for (const path of files) {
    const lang = language(path);
    if (!['rust', 'ts', 'css', 'shell', 'toml'].includes(lang)) continue;
    findings.push(...longComments(read(path), lang).map(finding => ({ path, ...finding })));
  }
  const rooms = new Map();
  for (const { path, line, text } of findings) {
    if (!countOnly) console.log(`${path}:${line}: ${text}`);
    rooms.set(room(path), (rooms.get(room(path)) ?? 0) + 1);
  }
  for (const [name, count] of rooms) console.log(`  ${String(count).padStart(5)}  ${name}`);
  console.log(
    `docs: ${findings.length} findings in ${documents.length} documents and the comments of ${files.length} files`,
  );
  return findings.length === 0;
}

if (process.argv[1] === new URL(import.meta.url).pathname) process.exitCode = main(process.argv.slice(2)) ? 0 : 1;
