// Finds the words of word-list.mjs, and doc comments that do not open with a noun or a verb.
//
//   words.mjs [--count] [PATH...]
//
// --count prints sums only; a PATH limits the search to paths that begin with it.
import { listFiles, read, room } from './files.mjs';
import { language, segments } from './lex.mjs';
import { OPENING, RULES } from './word-list.mjs';

const EXCEPTIONS = 'tools/checks/words.exceptions';
/** The largest share of doc comments with a wrong opening. */
const MAX_OPENINGS = 0.01;

/** Returns the parts of an identifier in lower case: `maxSpeed2` gives [max, speed2]. */
export function nameParts(ident) {
  return ident
    .replace(/([a-z0-9])([A-Z])/g, '$1_$2')
    .replace(/([A-Z])([A-Z][a-z])/g, '$1_$2')
    .toLowerCase()
    .split(/[_$-]+/)
    .filter(Boolean);
}

function nameHits(text, lang, rules, hits) {
  const pattern = lang === 'css' || lang === 'html' ? /[A-Za-z_][\w-]*/g : /[A-Za-z_$][\w$]*/g;
  for (const { 0: ident, index } of text.matchAll(pattern)) {
    const context = { ident, lang, after: text[index + ident.length] ?? '' };
    const parts = nameParts(ident);
    for (const rule of rules) if (rule.name?.(parts, context)) hits.push({ rule, text: ident });
  }
}

/** Code spans between backticks, and names with an underscore or a hump, are names in prose too. */
function proseHits(text, lang, rules, hits) {
  const prose = text.replace(/`[^`]*`|\b\w+_\w+\b|\b[a-z]+[A-Z]\w*\b/g, name => {
    nameHits(name, lang, rules, hits);
    return ' x ';
  });
  for (const rule of rules) {
    if (!rule.prose) continue;
    rule.all ??= new RegExp(rule.prose.source, `${rule.prose.flags}g`);
    for (const [text] of prose.matchAll(rule.all)) hits.push({ rule, text });
  }
}

/** Returns the hits of a source: `{ line, rule, text }`. */
export function findWords(source, lang) {
  const rules = RULES.filter(rule => !rule.langs || rule.langs.includes(lang));
  const out = [];
  for (const { line, kind, text } of segments(source, lang)) {
    const hits = [];
    if (kind === 'code') nameHits(text, lang, rules, hits);
    else if (kind !== 'string' || /\s/.test(text.trim())) proseHits(text, lang, rules, hits);
    else
      nameHits(
        text,
        'css',
        rules.filter(rule => rule.word !== 'place'),
        hits,
      );
    out.push(...hits.map(hit => ({ line, ...hit })));
  }
  return out;
}

/** Returns the hits in the name of a file. */
export function findInPath(path) {
  const hits = [];
  for (const part of path.split('/'))
    nameHits(part.replace(/\.\w+$/, '').replaceAll('-', '_'), language(path), RULES, hits);
  return hits.map(hit => ({ line: 0, ...hit }));
}

/** Returns the opening lines of the doc comments of a source: `{ line, text }`. */
export function docOpenings(source, lang) {
  const lines = source.split('\n');
  const out = [];
  lines.forEach((line, i) => {
    if (lang === 'rust') {
      const marker = /^\s*(\/\/[/!])(?!\/)/.exec(line)?.[1];
      const above = lines[i - 1] ?? '';
      if (marker && !new RegExp(`^\\s*${marker}(?!/)`).test(above))
        out.push({ line: i + 1, text: line.trim().slice(3).trim() });
    } else if (lang === 'ts') {
      const open = /^\s*\/\*\*(?!\/)(.*)/.exec(line);
      if (!open) return;
      const text = open[1].trim() || (lines[i + 1] ?? '').replace(/^\s*\*\s?/, '');
      out.push({ line: i + 1, text: text.replace(/\*\/.*$/, '').trim() });
    }
  });
  return out;
}

/** Parses the exceptions: `path | word | text or * | reason` a line; the path may end with `*`. */
export function parseExceptions(text) {
  const out = [];
  text.split('\n').forEach((line, i) => {
    if (!line.trim() || line.startsWith('#')) return;
    const [path, word, needle, reason] = line.split(' | ').map(part => part.trim());
    if (!reason) throw new Error(`${EXCEPTIONS}:${i + 1}: expected "path | word | text or * | reason"`);
    out.push({ line: i + 1, path, word, needle, used: 0 });
  });
  return out;
}

function excepted(exceptions, path, word, line) {
  const match = exceptions.find(
    e =>
      (e.path.endsWith('*') ? path.startsWith(e.path.slice(0, -1)) : path === e.path) &&
      (e.word === '*' || e.word === word) &&
      (e.needle === '*' || line.includes(e.needle)),
  );
  if (match) match.used += 1;
  return Boolean(match);
}

function table(counts) {
  const rooms = [...counts].sort(([, a], [, b]) => b - a);
  return rooms.map(([name, count]) => `  ${String(count).padStart(5)}  ${name}`).join('\n');
}

function main(args) {
  const countOnly = args.includes('--count');
  const prefixes = args.filter(arg => !arg.startsWith('--'));
  const exceptions = parseExceptions(read(EXCEPTIONS));
  const perRoom = new Map();
  const perWord = new Map();
  let total = 0;
  let docs = 0;
  const openings = [];
  for (const path of listFiles()) {
    if (prefixes.length && !prefixes.some(prefix => path.startsWith(prefix))) continue;
    const lang = language(path);
    const source = lang ? read(path) : '';
    const lines = source.split('\n');
    const hits = [...findInPath(path), ...(lang ? findWords(source, lang) : [])];
    for (const { line, rule, text } of hits) {
      if (excepted(exceptions, path, rule.word, line ? lines[line - 1] : path)) continue;
      total += 1;
      perRoom.set(room(path), (perRoom.get(room(path)) ?? 0) + 1);
      perWord.set(rule.word, (perWord.get(rule.word) ?? 0) + 1);
      if (!countOnly) console.log(`${path}${line ? `:${line}` : ''}: "${text}": use ${rule.use}`);
    }
    for (const { line, text } of lang ? docOpenings(source, lang) : []) {
      if (excepted(exceptions, path, 'opening', text)) continue;
      docs += 1;
      if (OPENING.test(text)) openings.push({ path, line, text });
    }
  }
  const share = docs ? openings.length / docs : 0;
  const openingsFail = share > MAX_OPENINGS;
  if (!countOnly)
    for (const { path, line, text } of openings) console.log(`${path}:${line}: opens with "${text.slice(0, 40)}"`);
  if (total) console.log(`Hits a room:\n${table(perRoom)}\nHits a word:\n${table(perWord)}`);
  if (countOnly && openings.length) {
    const rooms = new Map();
    for (const { path } of openings) rooms.set(room(path), (rooms.get(room(path)) ?? 0) + 1);
    console.log(`Doc openings a room:\n${table(rooms)}`);
  }
  const unused = prefixes.length ? [] : exceptions.filter(e => e.used === 0);
  for (const { line } of unused) console.log(`${EXCEPTIONS}:${line}: the exception matches nothing`);
  console.log(
    `words: ${total} hits; ${openings.length} of ${docs} doc comments (${(100 * share).toFixed(1)} %, at most 1 %) open ` +
      'with What, Whether, How, Where, Those, The same, One, Who or When',
  );
  return total === 0 && !openingsFail && unused.length === 0;
}

if (process.argv[1] === new URL(import.meta.url).pathname) process.exitCode = main(process.argv.slice(2)) ? 0 : 1;
