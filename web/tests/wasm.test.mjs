// The wasm face, as the worker uses it: scenes and errors as text, poses as a view on memory, and a state that can be taken back.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import init, { Simulation, namedScene, sceneList, towerScene } from '../src/wasm/teeter_wasm.js';

let memory;
before(async () => {
  const bytes = await readFile(new URL('../src/wasm/teeter_wasm_bg.wasm', import.meta.url));
  ({ memory } = await init({ module_or_path: bytes }));
});

const poses = simulation => new Float64Array(memory.buffer, simulation.posesPtr(), 7 * simulation.length);
const message = action => {
  try {
    action();
  } catch (error) {
    assert.ok(error instanceof Error, `an Error, not ${error}`);
    assert.ok(error.message.length > 0 && !error.message.includes('\n'), `one line, not ${JSON.stringify(error.message)}`);
    return error.message;
  }
  assert.fail('no error');
};

test('towers have three blocks a row, and the same seed makes the same tower', () => {
  const scene = JSON.parse(towerScene('{"rows": 4, "seed": 7}'));
  assert.equal(scene.blocks.length, 12);
  assert.equal(towerScene('{"rows": 4, "seed": 7}'), towerScene('{"rows": 4, "seed": 7}'));
  assert.notEqual(towerScene('{"rows": 4, "seed": 7}'), towerScene('{"rows": 4, "seed": 8}'));
  const official = JSON.parse(towerScene('{"rows": 3, "block": "official"}'));
  assert.equal(official.blocks[0].size[0], 0.075);
});

test('every scene of the list can be built', () => {
  const list = JSON.parse(sceneList());
  assert.ok(list.length > 0);
  for (const { name, title } of list) {
    assert.ok(name && title);
    const simulation = new Simulation(namedScene(name), '');
    assert.ok(simulation.length > 0);
    simulation.free();
  }
});

test('what is wrong is told in one line', () => {
  const scene = towerScene('{"rows": 3}');
  const with_ = change => {
    const copy = JSON.parse(scene);
    change(copy);
    return JSON.stringify(copy);
  };
  message(() => new Simulation('{', ''));
  message(() => new Simulation('', ''));
  message(() => new Simulation(scene.replace('0.4', 'NaN'), ''));
  message(
    () =>
      new Simulation(
        with_(s => delete s.friction),
        '',
      ),
  );
  message(
    () =>
      new Simulation(
        with_(s => (s.blocks[1].size[2] = 0)),
        '',
      ),
  );
  message(
    () =>
      new Simulation(
        with_(s => (s.blocks[1].mass = -1)),
        '',
      ),
  );
  assert.match(
    message(
      () =>
        new Simulation(
          with_(s => (s.stiffness = 1)),
          '',
        ),
    ),
    /stiffness.* N\/m/,
  );
  assert.match(
    message(() => new Simulation(scene, '{"stiffness": 1e6}')),
    /stiffness/,
  );
  assert.match(
    message(() => namedScene('nowhere')),
    /nowhere/,
  );
  assert.match(
    message(() => towerScene('{"rows": -1}')),
    /rows|options/,
  );
  message(() => towerScene('rows'));
  const simulation = new Simulation(scene, '');
  assert.match(
    message(() => simulation.step('{"hands": 1}')),
    /hands/,
  );
  assert.match(
    message(() => simulation.contacts(99)),
    /99/,
  );
  message(() => simulation.restore(new Uint8Array([1, 2, 3])));
  assert.equal(simulation.time(), 0, 'a refused input leaves the world as it was');
});

test('a step covers a sixtieth of a second and the poses follow in place', () => {
  const simulation = new Simulation(namedScene('block'), '');
  const sizes = simulation.sizes();
  assert.equal(sizes.length, 3);
  const before = poses(simulation).slice();
  let report;
  for (let i = 0; i < 60; i++) report = JSON.parse(simulation.step(''));
  assert.ok(Math.abs(report.time - 1) < 1e-9);
  assert.ok(Math.abs(simulation.time() - 1) < 1e-9);
  const after = poses(simulation);
  assert.ok(Math.abs(after[2] - before[2]) < 1e-4, 'a block at rest stays');
  assert.deepEqual(report.quarantined, []);
  const hand = { body: 0, anchor: [0, 0, 0], target: [before[0], before[1], before[2] + 0.05], grip: 'carry' };
  for (let i = 0; i < 60; i++) report = JSON.parse(simulation.step(JSON.stringify({ hand })));
  assert.ok(poses(simulation)[2] > before[2] + 0.03, `the hand lifts it: ${poses(simulation)[2]}`);
  assert.ok(report.hand.force[2] > 0);
  assert.equal(simulation.asleep(0), false);
});

test('the stiffness is that of the scene, and another one is another future', () => {
  const scene = JSON.parse(towerScene('{"rows": 3}'));
  const hashes = [3e5, 1e6].map(stiffness => {
    const simulation = new Simulation(JSON.stringify({ ...scene, stiffness }), '');
    assert.equal(simulation.stiffness, stiffness);
    for (let i = 0; i < 30; i++) simulation.step('');
    return simulation.hash();
  });
  assert.notEqual(hashes[0], hashes[1]);
});

test('a restored state goes on with the same bits', () => {
  const simulation = new Simulation(towerScene('{"rows": 6, "seed": 3}'), '{"sleep": false}');
  for (let i = 0; i < 20; i++) simulation.step('');
  const bytes = simulation.snapshot();
  const hashes = [0, 1].map(() => {
    simulation.restore(bytes);
    for (let i = 0; i < 20; i++) simulation.step('');
    return simulation.hash();
  });
  assert.match(hashes[0], /^[0-9a-f]{16}$/);
  assert.equal(hashes[0], hashes[1]);
  simulation.step('');
  assert.notEqual(simulation.hash(), hashes[0]);
});
