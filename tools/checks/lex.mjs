// Light lexer: splits a source file into code, comments, strings and prose.

/** Returns the language of a path, or null for a file that is not read. */
export function language(path) {
  const name = path.split('/').at(-1);
  if (/\.(rs)$/.test(name)) return 'rust';
  if (/\.(ts|mjs|js)$/.test(name)) return 'ts';
  if (/\.css$/.test(name)) return 'css';
  if (/\.html$/.test(name)) return 'html';
  if (/\.md$/.test(name)) return 'markdown';
  if (name === 'package.json') return 'package';
  if (/\.toml$/.test(name)) return 'toml';
  if (name === 'Makefile' || /\.sh$/.test(name)) return 'shell';
  if (!name.includes('.') && /^(tools|\.ci)\//.test(path)) return 'shell';
  return null;
}

/**
 * Returns the segments of a source: `{ line, kind, text }`. Kinds are code, comment, string, prose.
 * A segment never spans lines; comment text includes its marker.
 */
export function segments(text, lang) {
  const scan = { rust: scanRust, ts: scanTs, css: scanCss, html: scanHtml, markdown: scanMarkdown };
  if (scan[lang]) return splitLines(scan[lang](text));
  if (lang === 'package') return packageDescription(text);
  if (lang === 'toml' || lang === 'shell') return scanHash(text);
  return [];
}

/** Replaces comments and strings by spaces: positions and lines stay. */
export function codeOnly(text, lang) {
  const parts = lang === 'rust' ? scanRust(text) : scanTs(text);
  return parts.map(([kind, part]) => (kind === 'code' ? part : part.replace(/[^\n]/g, ' '))).join('');
}

function splitLines(parts) {
  const out = [];
  let line = 1;
  for (const [kind, part] of parts) {
    part.split('\n').forEach((text, i) => {
      if (i > 0) line += 1;
      if (text.trim()) out.push({ line, kind, text });
    });
  }
  return out;
}

/** Splits a text by `[kind, pattern]` pairs tried at each position; what matches none is code. */
function tokenize(text, start, patterns) {
  const parts = [];
  let from = 0;
  const take = (kind, begin, end) => {
    if (begin > from) parts.push(['code', text.slice(from, begin)]);
    parts.push([kind, text.slice(begin, end)]);
    from = end;
  };
  start.lastIndex = 0;
  for (let found = start.exec(text); found; found = start.exec(text)) {
    const at = found.index;
    let end = at + 1;
    for (const [kind, match] of patterns) {
      const length = match(text, at);
      if (!length) continue;
      end = at + length;
      if (kind !== 'code') take(kind, at, end);
      break;
    }
    start.lastIndex = end;
  }
  if (from < text.length) parts.push(['code', text.slice(from)]);
  return parts;
}

const sticky = (pattern, flags = '') => {
  const regex = new RegExp(pattern, `y${flags}`);
  return (text, at) => {
    regex.lastIndex = at;
    return regex.exec(text)?.[0].length ?? 0;
  };
};
const lineComment = sticky('//[^\\n]*');
const blockComment = sticky('/\\*[\\s\\S]*?(\\*/|$)');

function nestedComment(text, at) {
  if (!text.startsWith('/*', at)) return 0;
  let depth = 0;
  for (let i = at; i < text.length; i += 1) {
    if (text.startsWith('/*', i)) ((depth += 1), (i += 1));
    else if (text.startsWith('*/', i)) {
      ((depth -= 1), (i += 1));
      if (depth === 0) return i + 1 - at;
    }
  }
  return text.length - at;
}

function rawString(text, at) {
  const open = /^b?r(#*)"/.exec(text.slice(at, at + 12));
  if (!open || /\w/.test(text[at - 1] ?? '')) return 0;
  const end = text.indexOf(`"${open[1]}`, at + open[0].length);
  return (end < 0 ? text.length : end + 1 + open[1].length) - at;
}

function scanRust(text) {
  return tokenize(text, /[/"'rb]/g, [
    ['comment', lineComment],
    ['comment', nestedComment],
    ['string', rawString],
    ['string', sticky('"(?:\\\\[\\s\\S]|[^"\\\\])*"?')],
    ['string', sticky("'(?:\\\\[^\\n]*?|[^\\\\'\\n])'", 'u')],
    ['code', sticky("'\\w*")],
    ['code', sticky('[rb]\\w*')],
  ]);
}

function regexLiteral(text, at) {
  const before = text.slice(Math.max(0, at - 40), at).trimEnd();
  if (before && !/([(,=:[!&|?{};+]|\b(return|case|typeof))$/.test(before)) return 0;
  return sticky('/(?![*/])(?:\\\\.|\\[(?:\\\\.|[^\\]\\\\\\n])*\\]|[^/\\\\\\n[])+/[a-z]*')(text, at);
}

/** Length of a template string up to its end; the code of its `${}` counts as a part of it. */
function template(text, at) {
  if (text[at] !== '`') return 0;
  let depth = 0;
  for (let i = at + 1; i < text.length; i += 1) {
    if (text[i] === '\\') i += 1;
    else if (depth === 0 && text[i] === '`') return i + 1 - at;
    else if (text[i] === '`') i += template(text, i) - 1;
    else if (text.startsWith('${', i)) ((depth += 1), (i += 1));
    else if (depth > 0 && text[i] === '{') depth += 1;
    else if (depth > 0 && text[i] === '}') depth -= 1;
  }
  return text.length - at;
}

function scanTs(text) {
  return tokenize(text, /[/"'`]/g, [
    ['comment', lineComment],
    ['comment', blockComment],
    ['string', regexLiteral],
    ['string', sticky('"(?:\\\\[\\s\\S]|[^"\\\\\\n])*"?')],
    ['string', sticky("'(?:\\\\[\\s\\S]|[^'\\\\\\n])*'?")],
    ['string', template],
  ]);
}

function scanCss(text) {
  return tokenize(text, /[/"']/g, [
    ['comment', blockComment],
    ['string', sticky('"[^"\\n]*"?')],
    ['string', sticky("'[^'\\n]*'?")],
  ]);
}

/** Attributes whose values a reader sees. */
const READ = /\b(title|aria-label|aria-description|alt|placeholder|content)="[^"]*"/g;

function scanHtml(text) {
  const parts = [];
  for (const [, comment, tag, prose] of text.matchAll(/(<!--[\s\S]*?-->)|(<[^>]*>)|([^<]+)/g)) {
    if (comment) parts.push(['comment', comment]);
    else if (prose) parts.push(['prose', prose]);
    else {
      let from = 0;
      for (const { 0: attribute, index } of tag.matchAll(READ)) {
        parts.push(['code', tag.slice(from, index)], ['prose', attribute.replace(/^[\w-]+=/, '')]);
        from = index + attribute.length;
      }
      parts.push(['code', tag.slice(from)]);
    }
  }
  return parts;
}

function scanMarkdown(text) {
  const parts = [];
  let fence = null;
  for (const line of text.split(/(?<=\n)/)) {
    const mark = /^\s*(```+|~~~+)/.exec(line)?.[1];
    if (fence ? mark?.startsWith(fence) : mark) {
      fence = fence ? null : mark;
      parts.push(['code', line]);
    } else if (fence) parts.push(['code', line]);
    else {
      for (const [, code, target, prose] of line.matchAll(/(`+[^`]*`+)|(\]\([^)]*\))|([^`\]]+|[`\]])/g)) {
        parts.push([prose === undefined ? 'code' : 'prose', code ?? target ?? prose]);
      }
    }
  }
  return parts;
}

/** Shell, make and TOML: comments begin with `#`; quoted texts are strings. */
function scanHash(text) {
  const out = [];
  text.split('\n').forEach((whole, i) => {
    if (whole.startsWith('#!')) return;
    const at = /(^|\s)#/.exec(whole);
    const code = at ? whole.slice(0, at.index) : whole;
    const add = (kind, part) => part.trim() && out.push({ line: i + 1, kind, text: part });
    for (const part of code.split(/("(?:\\.|[^"\\])*"|'[^']*')/)) add(/^["'].*\s/.test(part) ? 'string' : 'code', part);
    if (at) add('comment', whole.slice(at.index));
  });
  return out;
}

function packageDescription(text) {
  const lines = text.split('\n');
  const at = lines.findIndex(line => /^\s*"description":/.test(line));
  return at < 0 ? [] : [{ line: at + 1, kind: 'string', text: lines[at].replace(/^\s*"description":/, '') }];
}
