import assert from 'node:assert/strict';
import test from 'node:test';
import { linked } from '../dependencies.mjs';

const source = 'registry+https://github.com/rust-lang/crates.io-index';

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
