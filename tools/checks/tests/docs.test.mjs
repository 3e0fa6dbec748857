import assert from 'node:assert/strict';
import { test } from 'node:test';
import { blocks, braces, links, longComments, longProse, named, pathTest, slug } from '../docs.mjs';

const LONG = 'word '.repeat(30).trim();

test('prose wraps; tables, code, headings, built parts and links may be long', () => {
  assert.deepEqual(longProse(LONG), [{ line: 1, text: '149 columns' }]);
  assert.deepEqual(longProse(`* ${LONG}`), [{ line: 1, text: '151 columns' }]);
  assert.deepEqual(longProse(`| ${LONG} |\n\n\`\`\`\n${LONG}\n\`\`\`\n# ${LONG}\n`), []);
  assert.deepEqual(longProse(`<!-- table: written -->\n${LONG}\n<!-- end of table -->\n`), []);
  assert.deepEqual(longProse(`![${LONG}](a.png)\n* [${LONG}](b.md)\n`), []);
});

test('a paragraph has at most eight lines, and an item of a list begins one', () => {
  assert.deepEqual(longProse('a\n'.repeat(8)), []);
  assert.deepEqual(longProse(`b\n\n${'a\n'.repeat(9)}`), [{ line: 3, text: 'a paragraph of 9 lines' }]);
  assert.deepEqual(longProse('* a\n'.repeat(9)), []);
  assert.equal(blocks('a\nb\n\nc').length, 2);
});

test('comments wrap; code and comments behind it may be longer', () => {
  assert.deepEqual(longComments(`// ${LONG}`, 'rust'), [{ line: 1, text: 'comment of 152 columns' }]);
  assert.deepEqual(longComments(`/**\n * ${LONG}\n */`, 'ts'), [{ line: 2, text: 'comment of 152 columns' }]);
  assert.deepEqual(
    longComments(`let a = "${LONG}"; // short\n/// | ${LONG} |\n// https://${'a'.repeat(100)}`, 'rust'),
    [],
  );
});

test('a path exists whole, from a folder on, as a folder, with braces or a star', () => {
  const exists = pathTest(['crates/a/src/lib.rs', 'crates/a/src/b/mod.rs']);
  for (const path of [
    'crates/a/src/lib.rs',
    'lib.rs',
    'b/',
    'src/b/mod.rs',
    'crates/a/src/*.rs',
    'web/dist/index.html',
  ]) {
    assert.ok(exists(path), path);
  }
  for (const path of ['crates/a/lib.rs', 'ib.rs', 'c/', 'crates/a/src/*.ts']) assert.ok(!exists(path), path);
  assert.deepEqual(braces('a/{b,c}.rs'), ['a/b.rs', 'a/c.rs']);
});

test('names of paths and crates are found in code', () => {
  const source =
    'See `a.rs`, `lanes/`, `x * y`, `N/m` and teeter-a.\n\n```\ncrates/a <- `teeter-b`, web/src/\n```\n`teeter-c`';
  assert.deepEqual(
    named(source, ['crates'], true).map(({ line, path, crate }) => `${line} ${path ?? crate}`),
    ['1 a.rs', '1 lanes/', '4 crates/a', '4 web/src/', '6 teeter-c'],
  );
  assert.deepEqual(named('`scene.json` `crates/a` `other/b`', ['crates'], false), [{ line: 1, path: 'crates/a' }]);
});

test('links are relative to their document', () => {
  assert.deepEqual(links('[a](b.md#c) `[x](y)` ![d](../e.png) [f](#g) [h](https://i)', 'docs/a.md'), [
    { line: 1, target: 'docs/b.md', anchor: 'c' },
    { line: 1, target: 'e.png', anchor: undefined },
    { line: 1, target: 'docs/a.md', anchor: 'g' },
  ]);
  assert.equal(slug('## Why it *holds*, in `a.rs`'), 'why-it-holds-in-ars');
});
