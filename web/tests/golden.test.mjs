// The page's engine gives the same bits as the native one, with vectors and without.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Clocked } from './cost.mjs';
import { BUILDS, bytes, load } from './engine.mjs';
import { golden, play } from './golden.mjs';

for (const build of Object.keys(BUILDS)) {
  test(`wasm ${build} gives the golden results`, async () => {
    const expected = await golden();
    assert.ok(expected.length >= 6);
    assert.deepEqual(await play(build), expected);
  });
}

test('a workload that is measured plays the golden run, each time', async () => {
  const face = await load('simd128');
  const { hash } = (await golden()).find(run => run.name === 'rest');
  const clocked = new Clocked(face, {
    scene: JSON.parse(face.namedScene('tower')),
    params: {},
    inputs: [],
    settle: 100,
    frames: 20,
  });
  for (let i = 0; i < 2; i++) {
    const stretch = clocked.play();
    assert.equal(stretch.hash, hash);
    assert.equal(stretch.frames.length, 20);
  }
});

test('one build has vectors and the other has none', async () => {
  const features = async build => {
    const sections = WebAssembly.Module.customSections(new WebAssembly.Module(await bytes(build)), 'target_features');
    return sections.map(section => Buffer.from(section).toString('latin1')).join();
  };
  assert.match(await features('simd128'), /\+.simd128/);
  assert.match(await features('scalar'), /sign-ext/);
  assert.doesNotMatch(await features('scalar'), /simd128/);
});
