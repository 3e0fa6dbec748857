import assert from 'node:assert/strict';
import test from 'node:test';
import { DUPLICATES, findings, isAccepted, linked } from '../dependencies.mjs';

test('expressions are met by one side of a choice, and by all of a sum', () => {
  const accepted = ['MIT', 'Zlib', 'Apache-2.0 WITH LLVM-exception'];
  for (const expression of [
    'MIT',
    'GPL-3.0 OR MIT',
    'MIT/Apache-2.0',
    '(GPL-3.0 OR MIT) AND Zlib',
    'Apache-2.0 WITH LLVM-exception',
    'MIT AND (Zlib OR GPL-3.0)',
  ])
    assert.equal(isAccepted(expression, accepted), true, expression);
  for (const expression of ['', 'GPL-3.0', 'MIT AND GPL-3.0', 'Apache-2.0', '(MIT OR GPL-3.0) AND GPL-3.0', 'MIT MIT'])
    assert.equal(isAccepted(expression, accepted), false, expression);
});

const source = 'registry+https://github.com/rust-lang/crates.io-index';
const crate = (name, version, more = {}) => ({ name, version, source, license: 'MIT', ...more });
const known = Object.keys(DUPLICATES).flatMap(name => [crate(name, '1.0.0'), crate(name, '2.0.0')]);

test('a licence, a source and a second version are found', () => {
  assert.deepEqual(findings(known), []);
  const bad = [
    crate('a', '1.0.0', { license: 'GPL-3.0' }),
    crate('b', '1.0.0', { license: null }),
    crate('c', '1.0.0', { source: 'git+https://example.org/c' }),
    crate('d', '1.0.0'),
    crate('d', '2.0.0'),
    crate('own', '1.0.0', { source: null, license: null }),
  ];
  assert.deepEqual(findings([...known, ...bad]), [
    'a 1.0.0: licence GPL-3.0',
    'b 1.0.0: licence not named',
    'c 1.0.0: from git+https://example.org/c, expected crates.io',
    'd: versions 1.0.0 and 2.0.0, without a reason in DUPLICATES',
  ]);
  const name = Object.keys(DUPLICATES)[0];
  const single = known.filter(found => found.name !== name || found.version === '1.0.0');
  assert.deepEqual(findings(single), [`${name}: has one version, remove it from DUPLICATES`]);
});

test('tests, build scripts and macros are not linked', () => {
  const packages = ['own', 'normal', 'inner', 'dev', 'build', 'macro', 'of-macro'].map(name => ({
    id: name,
    name,
    source: name === 'own' ? null : source,
    targets: [{ kind: [name === 'macro' ? 'proc-macro' : 'lib'] }],
  }));
  const dep = (pkg, kind = null) => ({ pkg, dep_kinds: [{ kind }] });
  const deps = {
    own: [dep('normal'), dep('dev', 'dev'), dep('build', 'build'), dep('macro')],
    normal: [dep('inner')],
    macro: [dep('of-macro')],
  };
  const nodes = packages.map(({ id }) => ({ id, deps: deps[id] ?? [] }));
  const names = linked({ packages, resolve: { nodes } }, ['own']).map(found => found.name);
  assert.deepEqual(names, ['normal', 'inner']);
});
