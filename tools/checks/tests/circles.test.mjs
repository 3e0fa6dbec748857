import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findCircles, groups } from '../circles.mjs';
import { expandUse, importGraph, parseCrate, withoutTests } from '../rust-modules.mjs';

/** Imports of a crate given as `{ path: source }`, as `from>to` without folders and endings. */
function imports(files) {
  const graph = importGraph(parseCrate('src/lib.rs', path => files[path] ?? null));
  const short = path => path.replace(/^src\//, '').replace(/\.rs$/, '');
  return [...graph].flatMap(([from, to]) => [...to].map(file => `${short(from)}>${short(file)}`)).sort();
}

test('a tree of use is expanded', () => {
  const names = expandUse('crate::a::{self, b::C as D, e::*}').map(({ path, name }) => `${path.join('::')} ${name}`);
  assert.deepEqual(names, ['crate::a a', 'crate::a::b::C D', 'crate::a::e *']);
});

test('imports by use, by path and by super lead to the file', () => {
  const files = {
    'src/lib.rs': 'mod a;\nmod b;\nmod c;\npub fn top() {}',
    'src/a.rs': 'use crate::b::B;\nfn f(_: B) { crate::c::g(); super::top() }',
    'src/b.rs': 'pub struct B;',
    'src/c.rs': 'pub fn g() {}',
  };
  assert.deepEqual(imports(files), ['a>b', 'a>c', 'a>lib']);
});

test('a declaration and a re-export by the parent import nothing', () => {
  const files = {
    'src/lib.rs': 'mod a;\npub use a::A;\npub const N: u32 = 1;',
    'src/a.rs': 'pub struct A([u8; crate::N as usize]);',
  };
  assert.deepEqual(imports(files), ['a>lib']);
  files['src/lib.rs'] += '\nfn f(_: A) {}';
  assert.deepEqual(imports(files), ['a>lib', 'lib>a']);
});

test('a re-exported item leads to the file that defines it', () => {
  const files = {
    'src/lib.rs': 'mod a;\nmod folder;',
    'src/a.rs': 'use crate::folder::{self, Deep, far};\nfn f(_: Deep) { folder::h(); far() }',
    'src/folder/mod.rs': 'mod deep;\nmod wide;\npub use deep::{Deep, h};\npub use wide::*;',
    'src/folder/deep.rs': 'pub struct Deep;\npub fn h() {}',
    'src/folder/wide.rs': 'pub fn far() {}',
  };
  assert.deepEqual(imports(files), ['a>folder/deep', 'a>folder/wide']);
});

test('a glob imports what is mentioned', () => {
  const files = {
    'src/lib.rs': 'mod a;\nmod b;\nfn unused() {}',
    'src/a.rs': 'use super::*;\nfn f() { b::g() }',
    'src/b.rs': 'pub fn g() {}',
  };
  assert.deepEqual(imports(files), ['a>b']);
});

test('tests, comments, strings, inline modules and other crates are no imports', () => {
  const files = {
    'src/lib.rs': 'mod a;\nmod b;',
    'src/a.rs':
      'use std::b::B;\n// crate::b::B\nconst S: &str = "crate::b::B";\n' +
      '#[cfg(test)]\nmod tests {\n use crate::b::B;\n}\nmod inner { pub fn f() {} }\nfn g() { inner::f() }',
    'src/b.rs': 'pub struct B;',
  };
  assert.deepEqual(imports(files), []);
  assert.equal(withoutTests('#[cfg(test)]\nmod tests;\nfn a() {}'), '            \n          \nfn a() {}');
});

test('a macro leads to the file that defines it', () => {
  const files = {
    'src/lib.rs': '#[macro_use]\nmod a;\nmod b;',
    'src/a.rs': 'macro_rules! each { () => {}; }',
    'src/b.rs': 'fn f() { each!() }',
  };
  assert.deepEqual(imports(files), ['b>a']);
});

test('a circle is found once, as a chain', () => {
  const graph = (...edges) => {
    const map = new Map();
    for (const [a, b] of edges) map.set(a, (map.get(a) ?? new Set()).add(b));
    return map;
  };
  assert.deepEqual(findCircles(graph('ab', 'bc', 'ac')), []);
  assert.deepEqual(findCircles(graph('ab', 'bc', 'ca', 'cd')), [['a', 'b', 'c', 'a']]);
  const two = findCircles(graph('ab', 'ba', 'bc', 'cb', 'de', 'ed'));
  assert.equal(two.length, 3);
  assert.equal(groups(two), 2);
});
