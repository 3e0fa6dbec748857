// The worker: owns the game, keeps it in step with the wall clock, and sends one message a step.

import load, { sceneList } from '../wasm/teeter_wasm.js';
import { calibrate } from './calibration';
import { CommandQueue } from './command-queue';
import { Device } from './device';
import { Game } from './game';
import { FRAME, type Update } from './game-protocol';
import { Loop } from './loop';
import { Speedometer } from './pacing';
import type { FromWorker, Question, SceneEntry, Setup, StateHash, ToWorker, Watched } from './protocol';
import { sceneText } from './scene';
import { errorText, guarded } from './worker-errors';

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

let memory: WebAssembly.Memory;
let game: Game | null = null;
let world = 0;
let paused = false;
let watched: Watched = { springs: false, xray: false, sound: false, selected: null };
/** Hashes that are recorded to answer a question. */
let recordings: { id: number; until: number; states: StateHash[] }[] = [];
/** Update of the last step of the world. */
let last: Update | null = null;
const commands = new CommandQueue();
const speedometer = new Speedometer();
const device = new Device(form => calibrate(form, seconds));
const guard = guarded(message => {
  game = null;
  send({ type: 'failed', message });
});
const loop = new Loop(
  seconds,
  () => game !== null && !paused,
  () => step(game!),
  guard,
);

function step(game: Game): void {
  const before = seconds();
  const wasAtRest = last?.at_rest ?? false;
  last = game.step(commands.next());
  const after = seconds();
  speedometer.add(after, FRAME, after - before);
  device.played(after - before, game.length, game.stiffness, game.form, game.springStiffness);
  sendFrame(game, last);
  if (last.at_rest !== wasAtRest) sendXRay(game);
  if (recordings.length > 0) record(game);
}

function record(game: Game): void {
  const state = { hash: game.hash(), time: game.time() };
  for (const { states } of recordings) states.push(state);
  const finished = recordings.filter(({ until }) => state.time >= until);
  for (const { id, states } of finished) send({ type: 'answer', id, value: states });
  recordings = recordings.filter(recording => !finished.includes(recording));
}

function sendXRay(game: Game): void {
  if (watched.xray) send({ type: 'xray', world, forces: last?.at_rest ? game.xray() : null });
}

function sendFrame(game: Game, update: Update): void {
  const poses = game.poses();
  const lattices = game.lattices(watched.springs);
  const sounds = watched.sound ? game.sounds() : null;
  send(
    {
      type: 'frame',
      world,
      update,
      applied: commands.applied,
      poses,
      lattices,
      sounds,
      placeable: watched.selected !== null && game.canPlace(watched.selected),
      factor: speedometer.factor(),
      capacity: speedometer.capacity(),
    },
    lattices ? [poses.buffer, lattices.buffer] : [poses.buffer],
  );
}

function restart(): void {
  speedometer.restart();
  loop.restart();
}

/** Builds a world; where that fails the previous one goes on. */
function build({ world: number, setup }: Extract<ToWorker, { type: 'build' }>): void {
  let next: Game;
  let chosen = { stiffness: false, form: false };
  try {
    if (setup.source.kind === 'record') next = Game.resume(setup.source.bytes, memory);
    else ({ next, chosen } = beginGame(setup.source, setup));
  } catch (error) {
    send({ type: 'refused', world: number, message: errorText(error) });
    return;
  }
  game?.free();
  game = next;
  last = null;
  world = number;
  commands.clear();
  device.begin();
  send({
    type: 'built',
    world,
    sizes: game.sizes(),
    poses: game.poses(),
    stiffness: { value: game.stiffness, chosen: chosen.stiffness },
    form: { value: game.form, chosen: chosen.form },
    springs: game.springStiffness,
    particleOffset: game.particleOffset,
    rules: game.rules,
    resumed: setup.source.kind === 'record',
  });
  restart();
}

function beginGame(source: Parameters<typeof sceneText>[0], setup: Setup) {
  const { sleep, stiffness, form, springs, rules } = setup;
  const chosen = { stiffness: stiffness === null, form: false };
  const scene = sceneText(source, defaults => {
    const wanted = { stiffness, form: form ?? defaults.form, springs: springs ?? defaults.springs };
    chosen.form = wanted.form === null;
    return { ...device.choose(defaults.blocks, wanted), springs: wanted.springs };
  });
  return { next: Game.begin(scene, sleep, rules, memory), chosen };
}

function watch(game: Game | null, next: Watched): void {
  const xrayChanged = next.xray !== watched.xray;
  watched = next;
  if (!game) return;
  if (xrayChanged) sendXRay(game);
  // While paused no frame would come with what is now watched; its events have been sent before.
  if (paused && last) sendFrame(game, { ...last, events: [] });
}

function answer(id: number, question: Question): void {
  if (question.what === 'hashes') {
    recordings.push({ id, until: question.until, states: [] });
    return;
  }
  const value = game && valueOf(game, question);
  send({ type: 'answer', id, value });
}

function valueOf(game: Game, question: Exclude<Question, { what: 'hashes' }>): unknown {
  switch (question.what) {
    case 'hash':
      return { hash: game.hash(), time: game.time() };
    case 'contacts':
      return game.contacts(question.body);
    case 'record':
      return game.record(question.state);
    case 'xray':
      return game.xray();
  }
}

function receive(message: ToWorker): void {
  switch (message.type) {
    case 'build':
      build(message);
      break;
    case 'command':
      if (message.world === world) commands.add(message.number, message.command);
      break;
    case 'pause':
      paused = message.paused;
      // A page that pauses a new world still needs its state.
      if (paused && game && !last) step(game);
      restart();
      break;
    case 'speed':
      loop.setSpeed(message.speed);
      break;
    case 'watch':
      watch(game, message.watched);
      break;
    case 'ask':
      answer(message.id, message.question);
      break;
  }
}

load().then(
  exports => {
    memory = exports.memory;
    const list = JSON.parse(sceneList()) as SceneEntry[];
    self.onmessage = (event: MessageEvent<ToWorker>) => guard(() => receive(event.data));
    send({ type: 'scenes', list });
  },
  (error: unknown) => send({ type: 'failed', message: `the engine did not load (${errorText(error)})` }),
);
