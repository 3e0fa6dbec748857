// The museum's worker: owns the tower of 2003, the engine's, or both. Two towers take each step
// together and with the same command, so the engine waits for the other one, which is much slower;
// simulated time falls behind the clock where it must.

import { CommandQueue, IDLE } from '../engine/command-queue';
import { Game } from '../engine/game';
import { FRAME, type TimedReport, type Update } from '../engine/game-protocol';
import { Loop } from '../engine/loop';
import { questionId } from '../engine/message-reader';
import { Speedometer } from '../engine/pacing';
import type { FromWorker } from '../engine/protocol';
import { sceneText } from '../engine/scene';
import { errorText, guarded, unlessRefused } from '../engine/worker-errors';
import loadMuseum from '../wasm/teeter_museum.js';
import loadEngine from '../wasm/teeter_wasm.js';
import { readToMuseum } from './message-reader';
import type { ConstantValues, MuseumFrame, MuseumQuestion, MuseumSetup, Report2003, ToMuseum } from './protocol';
import { Game2003 } from './tower-2003';

const BLOCK = 'dissertation';
/** Stiffness of the engine's contacts, N/m. */
const STIFFNESS = 1e6;

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker | MuseumFrame, transfer: Transferable[] = []) =>
  self.postMessage(message, { transfer });

let memory: { engine: WebAssembly.Memory; old: WebAssembly.Memory };
let engine: Game | null = null;
let old: Game2003 | null = null;
let world = 0;
let paused = false;
let selected: number | null = null;
const commands = new CommandQueue();
/** Speed of simulated time, and cost of each tower. */
const speed = { all: new Speedometer(), old: new Speedometer(), engine: new Speedometer() };
const guard = guarded(message => {
  engine = old = null;
  send({ type: 'failed', message });
});
const loop = new Loop(
  seconds,
  () => (engine !== null || old !== null) && !paused,
  () => step(),
  guard,
);

function timed<T>(meter: Speedometer, action: () => T): T {
  const before = seconds();
  const result = action();
  const after = seconds();
  meter.add(after, FRAME, after - before);
  return result;
}

/**
 * True for a tower whose hand held a block after the last step: the ghost releases it together with
 * the engine.
 */
let holds = { engine: false, ghost: false };

function step(): void {
  const before = seconds();
  // A ghost that could not release in the step of the engine does so before the next command.
  const command = engine && holds.ghost && !holds.engine ? IDLE : commands.next();
  const first = engine && timed(speed.engine, () => engine!.step(command));
  const releases = first !== null && !first.hand && holds.ghost && command.command === 'idle';
  const second = old && timed(speed.old, () => old!.step(releases ? { command: 'release' } : command));
  holds = { engine: first?.hand != null, ghost: first !== null && second?.hand != null };
  const after = seconds();
  speed.all.add(after, FRAME, after - before);
  sendFrame((first ?? second)!, second?.report ?? null);
}

function sendFrame(update: Update<TimedReport>, report: Report2003 | null): void {
  const shown = (engine ?? old)!;
  const arrays = old && { poses: old.poses(), lattices: old.lattices() };
  const wood = engine ? { poses: engine.poses(), lattices: null } : arrays!;
  const ghost = engine ? arrays : null;
  const frame: MuseumFrame = {
    type: 'frame',
    world,
    update,
    applied: commands.applied,
    ...wood,
    sounds: null,
    placeable: selected !== null && shown.canPlace(selected),
    factor: speed.all.factor(),
    capacity: speed.all.capacity(),
    replay: null,
    costs: { old: old && FRAME / speed.old.capacity(), engine: engine && FRAME / speed.engine.capacity() },
    old: report,
    ghost,
  };
  const sent = [wood.poses, wood.lattices, ghost?.poses, ghost?.lattices].filter(array => array != null);
  send(
    frame,
    sent.map(array => array.buffer),
  );
}

function restart(): void {
  for (const meter of Object.values(speed)) meter.restart();
  loop.restart();
}

/** Builds towers; where that fails the previous ones go on. */
function build({ world: number, setup }: { world: number; setup: MuseumSetup }): void {
  let next: { engine: Game | null; old: Game2003 | null };
  try {
    const { scene: name, rows, seed, show, constants } = setup;
    const choose = () => ({ form: 'rigid', stiffness: STIFFNESS, springs: null }) as const;
    const source = name ? ({ kind: 'named', name } as const) : ({ kind: 'tower', rows, seed, block: BLOCK } as const);
    const scene = sceneText(source, choose);
    next = {
      old: show === 'engine' ? null : new Game2003(scene, constants, memory.old),
      engine: show === 'old' ? null : Game.begin(scene, true, null, memory.engine),
    };
  } catch (error) {
    send({ type: 'refused', world: number, message: errorText(error) });
    return;
  }
  old?.free();
  engine?.free();
  ({ old, engine } = next);
  world = number;
  commands.clear();
  holds = { engine: false, ghost: false };
  const shown = (engine ?? old)!;
  send({
    type: 'built',
    world,
    sizes: shown.sizes(),
    poses: shown.poses(),
    stiffness: { value: STIFFNESS, chosen: false },
    form: { value: engine ? 'rigid' : 'lattice', chosen: false },
    springs: null,
    // The particles of 2003 are the corners.
    particleOffset: 1,
    rules: null,
    resumed: false,
    frames: null,
  });
  restart();
}

function answer(question: MuseumQuestion): unknown {
  const shown = engine ?? old;
  switch (question.what) {
    case 'constants':
      return Game2003.constants();
    case 'set':
      return setConstants(question.values);
    case 'contacts':
      return shown && shown.contacts(question.body);
    default:
      return null;
  }
}

/** Returns null, or why the constants are not accepted. */
function setConstants(values: ConstantValues): string | null {
  try {
    old?.setConstants(values);
    return null;
  } catch (error) {
    return errorText(error);
  }
}

/** Carries out a message. One that is refused changes nothing. */
function receive(data: unknown): void {
  unlessRefused(
    () => carryOut(readToMuseum(data)),
    message => send({ type: 'invalid', id: questionId(data), message }),
  );
}

function carryOut(message: ToMuseum): void {
  switch (message.type) {
    case 'build':
      build(message);
      break;
    case 'command':
      if (message.world === world) commands.add(message.number, message.command);
      break;
    case 'request':
      if (message.world === world) old?.request(message.request);
      break;
    case 'watch':
      selected = message.watched.selected;
      break;
    case 'ask':
      send({ type: 'answer', id: message.id, value: answer(message.question) });
      break;
    case 'pause':
      paused = message.paused;
      restart();
      break;
  }
}

Promise.all([loadEngine(), loadMuseum()]).then(
  ([ofEngine, ofOld]) => {
    memory = { engine: ofEngine.memory, old: ofOld.memory };
    self.onmessage = (event: MessageEvent<unknown>) => guard(() => receive(event.data));
    send({ type: 'scenes', list: [] });
  },
  (error: unknown) => send({ type: 'failed', message: `the simulators did not load (${errorText(error)})` }),
);
