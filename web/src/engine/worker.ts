// The worker: owns the game, keeps it in step with the wall clock, and sends one message a step.

import load, * as engine from '../wasm/teeter_wasm.js';
import { calibrate } from './calibration';
import { CommandQueue, IDLE } from './command-queue';
import { Device } from './device';
import { Game } from './game';
import { FRAME, type GameCommand, type Update } from './game-protocol';
import { Loop } from './loop';
import { questionId, readMessage } from './message-reader';
import { Speedometer } from './pacing';
import { isReplayed, type Played } from './played';
import type { FromWorker, Question, SceneEntry, Setup, StateHash, ToWorker, Watched } from './protocol';
import { replayed } from './replayed';
import { sceneText, type BuiltSource } from './scene';
import { errorText, guarded, unlessRefused } from './worker-errors';

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

let memory: WebAssembly.Memory;
let game: Played | null = null;
let world = 0;
/** Number of the world that was requested last. */
let requested = 0;
let paused = false;
let watched: Watched = { springs: false, xray: false, sound: false, selected: null };
/** Hashes that are recorded to answer a question. */
let recordings: { id: number; until: number; states: StateHash[] }[] = [];
/** Update of the last step of the world. */
let last: Update | null = null;
/** True at the end of a replay. */
let ended = false;
/** Frame of a replay that is sought; null where none is. */
let sought: number | null = null;
const commands = new CommandQueue();
const speedometer = new Speedometer();
const device = new Device(form => calibrate(form, seconds));
const guard = guarded(message => {
  game = null;
  send({ type: 'failed', message });
});
const loop = new Loop(
  seconds,
  () => game !== null && !paused && !ended,
  () => step(game!),
  guard,
);

function step(game: Played): void {
  const before = seconds();
  const wasAtRest = last?.at_rest ?? false;
  const update = game.step(nextCommand(game));
  const after = seconds();
  if (update === null) {
    ended = true;
    return;
  }
  last = update;
  speedometer.add(after, FRAME, after - before);
  // Neither keyframes nor another engine measure this one.
  if ((game.replay?.engine ?? 'own') === 'own')
    device.played(after - before, game.length, game.stiffness, game.form, game.springStiffness);
  sendFrame(game, last);
  if (last.at_rest !== wasAtRest) sendXRay(game);
  if (recordings.length > 0) record(game);
  if (game instanceof Game) ask(game);
}

/** The next command of the page, else that of a computer player. */
function nextCommand(game: Played): GameCommand {
  if (!commands.isEmpty || !(game instanceof Game)) return commands.next();
  return game.computerCommand() ?? IDLE;
}

/** Sends a new question of a computer player. */
function ask(game: Game): void {
  const asked = game.question();
  if (!asked) return;
  const state = game.world();
  send({ type: 'deliberation', world, ...asked, state }, [state.buffer as ArrayBuffer]);
}

/** Goes on toward the frame of a replay that is sought, a slice at a time. */
function seek(): void {
  if (!game || !isReplayed(game) || sought === null) return;
  if (!game.seek(sought)) {
    setTimeout(() => guard(seek));
    return;
  }
  sought = null;
  ended = false;
  const update = game.update();
  if (update) {
    last = { ...update, events: [] };
    sendFrame(game, last);
    sendXRay(game);
  }
  restart();
}

function record(game: Played): void {
  const state = { hash: game.hash(), time: game.time() };
  for (const { states } of recordings) states.push(state);
  const finished = recordings.filter(({ until }) => state.time >= until);
  for (const { id, states } of finished) send({ type: 'answer', id, value: states });
  recordings = recordings.filter(recording => !finished.includes(recording));
}

function sendXRay(game: Played): void {
  if (watched.xray) send({ type: 'xray', world, forces: last?.at_rest ? game.xray() : null });
}

function sendFrame(game: Played, update: Update): void {
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
      replay: game.replay,
    },
    lattices ? [poses.buffer, lattices.buffer] : [poses.buffer],
  );
}

function restart(): void {
  speedometer.restart();
  loop.restart();
}

/** Parts of a tower that the device chose. */
interface Chosen {
  stiffness: boolean;
  form: boolean;
}

/** Builds a world; where that fails the previous one goes on. */
async function build({ world: number, setup: { source, ...setup } }: Extract<ToWorker, { type: 'build' }>) {
  requested = number;
  let next: Played;
  let chosen: Chosen = { stiffness: false, form: false };
  try {
    if (source.kind === 'record') next = seated(Game.resume(source.bytes, memory), setup);
    // The engine of a record may have to be fetched.
    else if (source.kind === 'replay') next = await replayed(source.bytes, { engine, memory }, new URL(source.engines));
    else ({ next, chosen } = beginGame(source, setup));
  } catch (error) {
    if (requested === number) send({ type: 'refused', world: number, message: errorText(error) });
    return;
  }
  if (requested === number) begin(number, next, chosen, source.kind === 'record');
  else next.free();
}

/** Begins with a world that was built. */
function begin(number: number, next: Played, chosen: Chosen, resumed: boolean): void {
  game?.free();
  game = next;
  last = null;
  ended = false;
  sought = null;
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
    resumed,
    frames: game.replay?.frames ?? null,
  });
  restart();
}

function beginGame(source: BuiltSource, setup: Omit<Setup, 'source'>): { next: Game; chosen: Chosen } {
  const { sleep, stiffness, form, springs, rules } = setup;
  const chosen = { stiffness: stiffness === null, form: false };
  // A scene that somebody shared is taken as it is, or it would be another game.
  if (source.kind === 'scene') return { next: Game.begin(source.text, sleep, rules, memory), chosen };
  const scene = sceneText(source, defaults => {
    const wanted = { stiffness, form: form ?? defaults.form, springs: springs ?? defaults.springs };
    chosen.form = wanted.form === null;
    return { ...device.choose(defaults.blocks, wanted), springs: wanted.springs };
  });
  return { next: seated(Game.begin(scene, sleep, rules, memory), setup), chosen };
}

/** The game with its computer players. */
function seated(game: Game, { computers }: Pick<Setup, 'computers'>): Game {
  game.seat(computers);
  return game;
}

function watch(game: Played | null, next: Watched): void {
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

function valueOf(game: Played, question: Exclude<Question, { what: 'hashes' }>): unknown {
  switch (question.what) {
    case 'hash':
      return { hash: game.hash(), time: game.time() };
    case 'contacts':
      return game.contacts(question.body);
    case 'world':
      return game.world();
    case 'move':
      return game.lastMove();
    case 'record':
      return game.record(question.state);
    case 'xray':
      return game.xray();
  }
}

/** Carries out a message. One that is refused changes nothing. */
function receive(data: unknown): void {
  unlessRefused(
    () => carryOut(readMessage(data)),
    message => send({ type: 'invalid', id: questionId(data), message }),
  );
}

function carryOut(message: ToWorker): void {
  switch (message.type) {
    case 'build':
      build(message).catch((error: unknown) =>
        guard(() => {
          throw error;
        }),
      );
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
    case 'seek':
      if (message.world !== world) break;
      if (sought === null) setTimeout(() => guard(seek));
      sought = message.frame;
      break;
    case 'decided':
      if (message.world === world && game instanceof Game) game.decide(message.player, message.considered);
      break;
    case 'ask':
      answer(message.id, message.question);
      break;
  }
}

load().then(
  exports => {
    memory = exports.memory;
    const list = JSON.parse(engine.sceneList()) as SceneEntry[];
    self.onmessage = (event: MessageEvent<unknown>) => guard(() => receive(event.data));
    send({ type: 'scenes', list });
  },
  (error: unknown) => send({ type: 'failed', message: `the engine did not load (${errorText(error)})` }),
);
