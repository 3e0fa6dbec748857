import assert from 'node:assert/strict';
import { test } from 'node:test';
import { codeOnly, language, segments } from '../lex.mjs';
import { docOpenings, findInPath, findWords, nameParts, parseExceptions } from '../words.mjs';
import { OPENING } from '../word-list.mjs';

const words = (source, lang = 'rust') => findWords(source, lang).map(({ line, rule }) => `${line}:${rule.word}`);

test('an identifier is split at underscores and humps', () => {
  assert.deepEqual(nameParts('furthestBut'), ['furthest', 'but']);
  assert.deepEqual(nameParts('LEAST_EDGE_SINE'), ['least', 'edge', 'sine']);
  assert.deepEqual(nameParts('HTMLElement'), ['html', 'element']);
});

test('a noun is found in comments, texts, names and documents', () => {
  assert.deepEqual(words('// the way of the block'), ['1:way']);
  assert.deepEqual(words('let ways = 1;\n/// Far.\nfail("in no way")'), ['1:way', '3:way']);
  assert.deepEqual(words('It goes its way.\n', 'markdown'), ['1:way']);
  assert.deepEqual(words('<p title="the usual one">Anew</p>', 'html'), ['1:usual', '1:anew']);
  assert.deepEqual(words('# a sane value\nx = 1', 'toml'), ['1:sane']);
  assert.deepEqual(words('{\n"name": "anew",\n"description": "Anew"\n}', 'package'), ['3:anew']);
});

test('longer words and compounds that hold a word are no hits', () => {
  for (const text of [
    'always',
    'halfway',
    'gateway',
    'two-way',
    'one-way',
    'replace',
    'displacement',
    'release',
    'usually',
    'overlook',
  ]) {
    assert.deepEqual(words(`// it is ${text} here`), [], text);
  }
  assert.deepEqual(words('let displacement = replace(always, one_way);'), []);
  assert.deepEqual(words('// by the way'), ['1:way']);
});

test('a superlative is a hit as the prefix of a name only', () => {
  assert.deepEqual(words('const LEAST_BOUND: f64 = most; // at least one, at most two'), ['1:superlative']);
  assert.deepEqual(words('const furthestBut = atLeast(leastSquares);', 'ts'), ['1:superlative']);
  assert.deepEqual(words('// `longest_step` and longest_step, the longest step'), ['1:superlative', '1:superlative']);
});

test('place is a hit as a noun, and none as a verb', () => {
  for (const text of ['its place in the row', 'in place of rigid blocks', 'the first place', 'free places on top']) {
    assert.deepEqual(words(`// ${text}`), ['1:place'], text);
  }
  for (const text of [
    'you place a block',
    'it places it',
    'to place blocks',
    'two decimal places',
    'placing takes time',
  ]) {
    assert.deepEqual(words(`// ${text}`), [], text);
  }
  assert.deepEqual(words('let place = at.place;'), ['1:place', '1:place']);
  assert.deepEqual(words('hand.place(slot); Command::PlaceAt(slot); can_place'), []);
  assert.deepEqual(words('a { place-items: center; }', 'css'), []);
});

test('kept and held are hits as constants and none as verbs', () => {
  assert.deepEqual(words('const KEPT: u32 = 3; // it is kept, and held'), ['1:kept']);
  assert.deepEqual(words('let kept = held;'), []);
});

test('code in a document and a string of one word are names', () => {
  assert.deepEqual(words('See `least_near` and the least distance.', 'markdown'), ['1:superlative']);
  assert.deepEqual(words("classList.add('leash');", 'ts'), ['1:leash']);
  assert.deepEqual(words('const a = `a ${b ? `way` : c} way`;', 'ts'), ['1:way', '1:way']);
});

test('the lexer tells code, comments and strings apart', () => {
  assert.equal(
    codeOnly(`let a = '"'; // b "c"\nlet d = r#"e " f"#;`, 'rust'),
    `let a =    ;         \nlet d =           ;`,
  );
  assert.equal(codeOnly('fn a<\'a>(b: &\'a str) { "x\\"y" }', 'rust'), "fn a<'a>(b: &'a str) {        }");
  assert.equal(codeOnly("a.replace(/'\\/[/]/g, b) / 2 // c", 'ts'), 'a.replace(         , b) / 2     ');
  assert.deepEqual(
    segments('a /* b\nc */ d', 'ts').map(({ line, kind }) => `${line}:${kind}`),
    ['1:code', '1:comment', '2:comment', '2:code'],
  );
});

test('files are known by their names', () => {
  assert.equal(language('tools/words'), 'shell');
  assert.equal(language('crates/a/src/lib.rs'), 'rust');
  assert.equal(language('docs/teeter.png'), null);
  assert.deepEqual(
    findInPath('web/src/stillness.ts').map(({ rule }) => rule.word),
    ['stillness'],
  );
  assert.deepEqual(findInPath('docs/placing-blocks.md'), []);
});

test('doc comments are counted by their first lines', () => {
  const rust = '//! Poses of blocks.\n//! More.\n\n/// What a block is.\n/// Where it is.\nstruct A;\n// When\n';
  assert.deepEqual(docOpenings(rust, 'rust'), [
    { line: 1, text: 'Poses of blocks.' },
    { line: 4, text: 'What a block is.' },
  ]);
  const ts = '/** Where it is. */\n/**\n * Returns it.\n */\n/* One */\n';
  assert.deepEqual(docOpenings(ts, 'ts'), [
    { line: 1, text: 'Where it is.' },
    { line: 2, text: 'Returns it.' },
  ]);
  assert.ok(OPENING.test('The same as above'));
  assert.ok(!OPENING.test('Ones in a row'));
});

test('an exception needs a reason', () => {
  assert.throws(() => parseExceptions('web/* | way | *'), /expected/);
  assert.deepEqual(parseExceptions('# note\n\nweb/* | way | the | because'), [
    { line: 3, path: 'web/*', word: 'way', needle: 'the', used: 0 },
  ]);
});
