// The wasm face, as the worker uses it: scenes and errors as text, poses as a view on memory, and a
// state that can be taken back.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import loadMuseum, { SpaceGame } from '../src/wasm/teeter_museum.js';
import init, {
  Game,
  Listener,
  Replay,
  Simulation,
  namedScene,
  sceneList,
  towerScene,
} from '../src/wasm/teeter_wasm.js';

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
    assert.ok(
      error.message.length > 0 && !error.message.includes('\n'),
      `one line, not ${JSON.stringify(error.message)}`,
    );
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

test('errors are one line', () => {
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

test('the X-ray has loads that add up and as many loose blocks as the study natively', () => {
  const text = towerScene('{"rows": 18, "seed": 1}');
  const simulation = new Simulation(text, '');
  for (let i = 0; i < 120; i++) simulation.step('');
  const xray = simulation.xray();
  assert.equal(xray.length, 2 * 54);
  const [loads, pulls] = [0, 1].map(k => xray.filter((_, i) => i % 2 === k));
  assert.equal(pulls.filter(pull => pull < 0.1).length, 27);
  const weights = JSON.parse(text).blocks.map(block => 9.81 * block.mass);
  const sum = part => part.reduce((a, b) => a + b, 0);
  for (let row = 0; row < 18; row++) {
    const [borne, above] = [sum(loads.slice(3 * row, 3 * row + 3)), sum(weights.slice(3 * row + 3))];
    assert.ok(Math.abs(borne - above) < 1e-3 * (above + 1), `row ${row} bears ${borne} of ${above} N`);
  }
  // A loose block is held by its own weight alone.
  pulls.forEach(
    (pull, i) => loads[i] === 0 && assert.ok(Math.abs(pull / (0.4 * weights[i]) - 1) < 0.02, `block ${i}: ${pull} N`),
  );
});

const lattices = simulation => {
  const at = simulation.latticesPtr();
  return new Float32Array(memory.buffer, at, simulation.form === 'lattice' ? 52 * simulation.length : 0);
};

test('blocks get springs and lose them where they are, and an invalid form is an error of one line', () => {
  const simulation = new Simulation(towerScene('{"rows": 6}'), '{"sleep": false}');
  for (let i = 0; i < 60; i++) simulation.step('');
  const before = poses(simulation).slice();
  const maxDisplacement = () => {
    const now = poses(simulation);
    return Math.max(...before.map((x, i) => (i % 7 < 3 ? Math.abs(now[i] - x) : 0)));
  };
  assert.deepEqual([simulation.form, simulation.springStiffness], ['rigid', undefined]);
  simulation.setForm('{"form": "lattice"}');
  assert.deepEqual([simulation.form, simulation.springStiffness], ['lattice', simulation.stiffness]);
  for (let i = 0; i < 30; i++) simulation.step('');
  assert.ok(maxDisplacement() < 1e-4, `${maxDisplacement()} m`);
  assert.match(
    message(() => simulation.setForm('{"form": "lattice", "springs": {"stiffness": 1}}')),
    /springs.stiffness.* N\/m/,
  );
  assert.match(
    message(() => simulation.setForm('{"form": "jelly"}')),
    /form/,
  );
  assert.equal(simulation.springStiffness, simulation.stiffness, 'a refused form leaves the world as it was');
  simulation.setForm('{"form": "rigid"}');
  for (let i = 0; i < 30; i++) simulation.step('');
  assert.ok(maxDisplacement() < 1e-4, `${maxDisplacement()} m`);
});

test('particles lie in their block, and its springs carry what is above it', () => {
  const simulation = new Simulation(towerScene('{"rows": 6}'), '{"sleep": false}');
  assert.equal(lattices(simulation).length, 0);
  simulation.setForm('{"form": "lattice", "springs": {"stiffness": 1e6}}');
  for (let i = 0; i < 60; i++) simulation.step('');
  const all = lattices(simulation);
  assert.equal(all.length, 52 * 18);
  const at = poses(simulation);
  for (let body = 0; body < 18; body++) {
    const centre = [0, 1, 2].map(
      k => Array.from({ length: 8 }, (_, i) => all[52 * body + 3 * i + k]).reduce((a, b) => a + b) / 8,
    );
    centre.forEach((x, k) => assert.ok(Math.abs(x - at[7 * body + k]) < 1e-6, `centre of block ${body}`));
  }
  // What the springs of a row press down with: the vertical part of each that joins a lower to an
  // upper particle.
  const load = row => {
    let sum = 0;
    for (let body = 3 * row; body < 3 * row + 3; body++) {
      let n = 0;
      for (let i = 0; i < 8; i++) {
        for (let j = i + 1; j < 8; j++, n++) {
          if (((i >> 2) & 1) === ((j >> 2) & 1)) continue;
          const spring = [0, 1, 2].map(k => all[52 * body + 3 * j + k] - all[52 * body + 3 * i + k]);
          sum -= all[52 * body + 24 + n] * (Math.abs(spring[2]) / Math.hypot(...spring));
        }
      }
    }
    return sum;
  };
  const masses = JSON.parse(towerScene('{"rows": 6}')).blocks.map(block => block.mass);
  // A particle is at 1/√3 of the distance to a face, and by virtual work has so much more to bear
  // than the face.
  const lever = Math.sqrt(3);
  for (let row = 0; row < 6; row++) {
    // All rows above, and the upper half of the row itself.
    const sum = part => part.reduce((a, b) => a + b, 0);
    const weight = 9.81 * (sum(masses.slice(3 * row + 3)) + sum(masses.slice(3 * row, 3 * row + 3)) / 2);
    assert.ok(Math.abs(load(row) / (lever * weight) - 1) < 0.01, `row ${row}: ${load(row)} N for ${weight} N`);
  }
});

const step = (game, command) => JSON.parse(game.step(command ? JSON.stringify(command) : ''));
const settledGame = options => {
  const game = new Game(towerScene(JSON.stringify(options)), '');
  for (let i = 0; i < 60; i++) game.step('');
  return game;
};
/** Grasps the middle block of the top row and lifts it by 60 mm. */
const lift = game => {
  const body = game.length - 2;
  step(game, { command: 'grasp', body, anchor: [0, 0, 0.009], normal: [0, 0, 1], grip: 'auto' });
  let update;
  for (let i = 0; i < 30; i++) update = step(game, { command: 'move', displacement: [0, 0, 0.002] });
  return { body, update };
};

test('a game without commands steps as a simulation does', () => {
  const scene = towerScene('{"rows": 6, "seed": 2}');
  const [game, simulation] = [new Game(scene, ''), new Simulation(scene, '')];
  for (let i = 0; i < 60; i++) {
    const update = step(game);
    assert.deepEqual(update.report, JSON.parse(simulation.step('')));
    assert.deepEqual([update.hand, update.slots, update.fallen, update.events], [null, [], [], []]);
  }
  assert.equal(game.hash(), simulation.hash());
  assert.deepEqual(poses(game), poses(simulation));
  assert.deepEqual(
    [game.length, game.stiffness, game.form, game.springStiffness, game.time()],
    [simulation.length, simulation.stiffness, 'rigid', undefined, simulation.time()],
  );
  assert.deepEqual([...game.sizes()], [...simulation.sizes()]);
  assert.deepEqual([...game.xray()], [...simulation.xray()]);
  assert.equal(game.contacts(4), simulation.contacts(4));
  assert.equal(game.asleep(4), simulation.asleep(4));
});

test('a game comes to rest, and a block is lifted out and placed on top again', () => {
  const game = settledGame({ rows: 6, seed: 2 });
  let update;
  for (let i = 0; i < 60; i++) update = step(game);
  assert.deepEqual([update.tower, update.at_rest], ['standing', true]);
  assert.equal(game.isFree(4), false);
  const { body, update: lifted } = lift(game);
  assert.equal(game.isFree(body), true);
  assert.equal(lifted.at_rest, false);
  assert.deepEqual([lifted.hand.body, lifted.hand.grip, lifted.hand.mode], [body, 'carry', 'auto']);
  assert.deepEqual(
    lifted.slots.map(({ row, cell }) => [row, cell]),
    [[5, 1]],
  );
  assert.deepEqual(JSON.parse(game.slots(body)), lifted.slots);
  assert.equal(game.canPlace(body), true);
  update = step(game, { command: 'place', body: null, slot: null });
  assert.equal(update.hand.placing, true);
  const events = [];
  for (let i = 0; i < 240 && events.length === 0; i++) events.push(...step(game).events);
  assert.deepEqual(events, [{ event: 'placed', body, slot: { row: 5, cell: 1 } }]);
  for (let i = 0; i < 60; i++) update = step(game);
  assert.deepEqual([update.hand, update.tower, update.fallen], [null, 'standing', []]);
});

test('a command that means nothing is refused with a reason, and text that is none is an error', () => {
  const game = settledGame({ rows: 3 });
  const time = game.time();
  const { events } = step(game, { command: 'release' });
  assert.deepEqual(events, [{ event: 'refused', reason: 'no block is held' }]);
  assert.ok(game.time() > time, 'the frame is stepped all the same');
  for (const text of ['{', 'release', '{"command": "fly"}', '{"command": "move"}', '{"command": "place", "x": 1}'])
    assert.match(
      message(() => game.step(text)),
      /^command: /,
    );
  assert.match(
    message(() => game.slots(99)),
    /99/,
  );
  message(() => game.restore(new Uint8Array([1, 2, 3])));
  message(() => new Game('{', ''));
});

test('a game restored in the middle of a placement goes on with the same bits', () => {
  const game = settledGame({ rows: 6, seed: 2 });
  step(game, { command: 'set_blocks', form: 'lattice', spring_stiffness: 1e5 });
  lift(game);
  step(game, { command: 'place' });
  for (let i = 0; i < 20; i++) step(game);
  const bytes = game.snapshot();
  const play = () => {
    const updates = [];
    for (let i = 0; i < 120; i++) updates.push(game.step(''));
    return updates.concat(game.hash());
  };
  const first = play();
  game.restore(bytes);
  assert.deepEqual(play(), first);
  assert.ok(lattices(game).length > 0);
});

test('a replay sounds as its game did, and a jump to another frame is silent', () => {
  const game = new Game(namedScene('pile'), '', '');
  game.startRecord();
  const heard = [];
  const listener = new Listener(game);
  for (let frame = 0; frame < 60; frame++) {
    game.step('');
    heard.push([...listener.hear(game)]);
  }
  assert.ok(heard.flat().length > 100);
  const replay = new Replay(game.record(false));
  assert.deepEqual([...replay.sounds()], []);
  for (const frame of heard) {
    replay.step();
    assert.deepEqual([...replay.sounds()], frame);
  }
  const loud = heard.findIndex((sounds, frame) => frame > 5 && sounds.length > 14);
  while (!replay.seek(loud, 600));
  assert.deepEqual([...replay.sounds()], []);
  replay.step();
  assert.ok(replay.sounds().length > 0, 'heard again from there');
});

test('the tower of 2003 takes the same commands as the game', async () => {
  const bytes = await readFile(new URL('../src/wasm/teeter_museum_bg.wasm', import.meta.url));
  const museum = await loadMuseum({ module_or_path: bytes });
  const game = new SpaceGame(towerScene('{"rows": 3}'), '{}');
  const { body, update } = lift(game);
  const height = new Float64Array(museum.memory.buffer, game.posesPtr(), 7 * game.length)[7 * body + 2];
  assert.ok(height > 0.075, `lifted to ${height} m`);
  assert.deepEqual([update.hand.grip, update.form, update.at_rest], ['carry', 'lattice', false]);
  for (const field of ['time', 'active', 'touching', 'max_speed', 'rounds', 'unresolved'])
    assert.equal(typeof update.report[field], 'number', field);
  assert.ok(update.report.tests.potential > 0);
  const lattices = new Float32Array(museum.memory.buffer, game.latticesPtr(), 52 * game.length);
  assert.ok(Math.abs(lattices[52 * body + 2] - height) < 0.02, 'a particle of the lifted block');
  const { events } = step(game, { command: 'turn', rotation: [0, 0, 0, 1] });
  assert.deepEqual(events, [{ event: 'refused', reason: 'this hand cannot turn a block' }]);
  assert.match(
    message(() => game.contacts(9)),
    /9/,
  );
});
