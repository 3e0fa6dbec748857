import assert from 'node:assert/strict';
import test from 'node:test';
import { findings, listed, unsafeParts } from '../unsafe.mjs';

test('unsafe code is found in code, not in comments and texts', () => {
  const source = [
    '// unsafe { in a comment }',
    'let text = "unsafe { in a text }";',
    '// SAFETY: the index is checked.',
    'let x = unsafe { *p };',
    '/// # Safety',
    '/// The pointer is valid.',
    'pub unsafe fn read() {}',
    '',
    '',
    '',
    '',
    '',
    'unsafe { bad() }',
  ].join('\n');
  assert.deepEqual(unsafeParts(source), [
    { line: 4, kind: 'block', reasoned: true },
    { line: 7, kind: 'fn', reasoned: true },
    { line: 13, kind: 'block', reasoned: false },
  ]);
});

test('a missing entry, a wrong number and a file that is gone are found', () => {
  const files = {
    'docs/unsafe.md': '| file | parts | reason |\n|---|---|---|\n| `a.rs` | 1 | why |\n| `gone.rs` | 2 | why |\n',
    'a.rs': '// SAFETY: a\nunsafe { a() }',
    'b.rs': '// SAFETY: b\nunsafe { b() }',
  };
  const all = findings(Object.keys(files), path => files[path]);
  assert.deepEqual(all, ['b.rs: 1 unsafe parts, 0 in docs/unsafe.md', 'docs/unsafe.md: gone.rs is not there']);
  assert.deepEqual(
    [...listed(files['docs/unsafe.md'])],
    [
      ['a.rs', 1],
      ['gone.rs', 2],
    ],
  );
});

test('the list is that of the code', () => {
  assert.deepEqual(findings(), []);
});
