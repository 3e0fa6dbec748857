// Builds and frees what the modules export, again and again, and measures their memory, which never
// shrinks. Run as a program it prints a line for each kind: `node tests/leak.mjs [BUILDS]`.

import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { load } from './engine.mjs';

/** Part of the builds that may let memory grow. */
const WARM_UP = 0.1;
/** Largest growth after that. */
export const MAX_GROWTH = 0.01;

const ROWS = '{"rows": 2, "seed": 3}';
const GRASP = { command: 'grasp', body: 4, anchor: [0, 0, 0.009], normal: [0, 0, 1], grip: 'auto' };
const MOVE = { command: 'move', displacement: [0, 0, 0.002], slot: null, toward_viewer: null };

/** Runs an action that is refused. */
function refused(action) {
  try {
    action();
  } catch {
    return;
  }
  throw new Error('the action was not refused');
}

function game({ Game, Listener, Opponent, towerScene }) {
  const game = new Game(towerScene(ROWS), '', Game.rules('official', 2));
  game.startRecord();
  const [listener, opponent] = [new Listener(game), new Opponent(0, 'expert', 1, 10)];
  for (const command of [GRASP, MOVE, MOVE, { command: 'release' }]) {
    game.step(JSON.stringify(command));
    listener.hear(game);
    opponent.question(game);
  }
  game.restore(game.snapshot());
  refused(() => game.step('{"command": "fly"}'));
  [game.record(true), game.world(), game.contacts(4), game.xray(), game.latticesPtr()].at(0);
  for (const part of [listener, opponent, game]) part.free();
}

function simulation({ Simulation, towerScene }) {
  const simulation = new Simulation(towerScene(ROWS), '{"ramp": 0.3}');
  simulation.setForm('{"form": "lattice"}');
  simulation.step('');
  simulation.restore(simulation.snapshot());
  refused(() => simulation.restore(new Uint8Array(100)));
  simulation.free();
}

function refusedScene({ Game, towerScene }) {
  const scene = JSON.parse(towerScene(ROWS));
  // The last block is within the one before.
  scene.blocks.at(-1).pos = scene.blocks.at(-2).pos;
  refused(() => new Game(JSON.stringify(scene), ''));
  refused(() => new Game('{', ''));
}

const replay = record => face => {
  const replay = new face.Replay(record);
  for (let i = 0; i < 3; i++) replay.step();
  replay.world();
  replay.free();
  const resumed = face.Game.resume(record);
  resumed.free();
  const keyframes = new face.Keyframes(record);
  keyframes.poses(0.5);
  keyframes.free();
  refused(() => new face.Replay(record.subarray(0, record.length / 2)));
};

const analysis = ({ Game, TowerAnalysis, Thought, Opponent, towerScene }) => {
  const game = new Game(towerScene(ROWS), '', Game.rules('official', 2));
  const opponent = new Opponent(0, 'random', 1, 2);
  for (let i = 0; i < 2; i++) game.step('');
  const question = opponent.question(game);
  const tasks = [new TowerAnalysis(game.world(), '', 1, 1)];
  if (question) tasks.push(new Thought(game.world(), question));
  for (const part of [...tasks, opponent, game]) part.free();
};

const museum =
  ({ SpaceGame, Plane }, { towerScene }) =>
  () => {
    const game = new SpaceGame(towerScene('{"rows": 2}'), '{}');
    game.step(JSON.stringify(GRASP));
    game.free();
    const plane = new Plane('{"method": "springs", "setting": "stack", "count": 3}');
    plane.advance(5);
    plane.report();
    plane.free();
    refused(() => new Plane('{"method": 1}'));
  };

/** A short record of a game. */
function recorded({ Game, towerScene }) {
  const game = new Game(towerScene(ROWS), '');
  game.startRecord();
  for (const command of [GRASP, ...Array(30).fill(MOVE)]) game.step(JSON.stringify(command));
  const bytes = game.record(true);
  game.free();
  return bytes;
}

/** Kinds of builds: `[name, action, exports of the module]`. */
export async function kinds() {
  const face = await load('simd128');
  const engine = await face.default();
  const museumUrl = new URL('../src/wasm/teeter_museum', import.meta.url).href;
  const old = await import(`${museumUrl}.js`);
  const oldExports = await old.default({ module_or_path: await readFile(new URL(`${museumUrl}_bg.wasm`)) });
  return [
    ['game', () => game(face), engine],
    ['simulation', () => simulation(face), engine],
    ['refused scene', () => refusedScene(face), engine],
    ['replay', () => replay(recorded(face))(face), engine],
    ['analysis', () => analysis(face), engine],
    ['museum', museum(old, face), oldExports],
  ];
}

/** Repeats an action. Returns the memory after the warm-up, bytes, and the growth from then on. */
export function measure(action, { memory, __wbindgen_externrefs: references }, count) {
  const now = () => memory.buffer.byteLength + references.length;
  let before = 0;
  for (let i = 0; i < count; i++) {
    action();
    if (i === Math.floor(WARM_UP * count)) before = now();
  }
  return { memory: before, growth: now() / before - 1 };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const count = Number(process.argv[2] ?? 10_000);
  for (const [name, action, exports] of await kinds()) {
    const { memory, growth } = measure(action, exports, count);
    console.log(`${name}: ${count} builds, memory ${(memory / 1e6).toFixed(2)} MB, growth ${growth.toFixed(4)}`);
    if (growth > MAX_GROWTH) process.exitCode = 1;
  }
}
