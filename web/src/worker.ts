// The worker: owns the world, keeps it in step with the wall clock, and sends one message a step.

import { Device } from './device';
import { Pace, Speedometer } from './pacing';
import { FRAME, type FromWorker, type Question, type SceneEntry, type ToWorker } from './protocol';
import { Simulator, sceneText } from './simulator';
import { trial } from './trial';
import load, { sceneList } from './wasm/teeter_wasm.js';

/** Time that may be owed before simulated time slows, s: rides out a hiccup of the machine. */
const MOST_DEBT = 4 * FRAME;

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

let memory: WebAssembly.Memory;
let simulator: Simulator | null = null;
let world = 0;
let paused = false;
let timer: number | null = null;
let queued = false;
const pace = new Pace(FRAME, MOST_DEBT);
const speedometer = new Speedometer();
const device = new Device(() => trial(seconds));

// A message to oneself comes back at once but after the messages of the page: a hand is never starved, and no timer is clamped to 4 ms.
const soon = new MessageChannel();
soon.port1.onmessage = () => {
  queued = false;
  guard(tick);
};

function tick(): void {
  timer = null;
  if (!simulator || paused) return;
  pace.advance(seconds());
  if (pace.take()) step(simulator);
  schedule();
}

function schedule(): void {
  if (!simulator || paused || timer !== null || queued) return;
  const wait = pace.wait() * 1000;
  if (wait < 1) {
    queued = true;
    soon.port2.postMessage(null);
  } else {
    timer = self.setTimeout(() => guard(tick), wait);
  }
}

function step(simulator: Simulator): void {
  const before = seconds();
  const { report, hand, handDone } = simulator.step();
  const after = seconds();
  speedometer.add(after, FRAME, after - before);
  device.played(after - before, simulator.length, simulator.stiffness);
  const poses = simulator.poses();
  send(
    {
      type: 'frame',
      world,
      time: report.time,
      poses,
      hand,
      handDone,
      awake: report.awake,
      touching: report.touching,
      penetration: report.penetration,
      maxSpeed: report.max_speed,
      quarantined: report.quarantined,
      factor: speedometer.factor(),
      capacity: speedometer.capacity(),
    },
    [poses.buffer],
  );
}

function restart(): void {
  if (timer !== null) clearTimeout(timer);
  timer = null;
  pace.restart();
  speedometer.restart();
  pace.advance(seconds());
  schedule();
}

/** Builds the world that is asked for; where that fails the old one goes on. */
function build(order: Extract<ToWorker, { type: 'build' }>): void {
  const { source, sleep, stiffness } = order.setup;
  let next: Simulator;
  try {
    next = new Simulator(
      sceneText(source, blocks => stiffness ?? device.choose(blocks)),
      sleep,
      memory,
    );
  } catch (error) {
    send({ type: 'refused', world: order.world, message: text(error) });
    return;
  }
  simulator?.free();
  simulator = next;
  world = order.world;
  device.begin();
  send({
    type: 'built',
    world,
    sizes: next.sizes(),
    poses: next.poses(),
    stiffness: { value: next.stiffness, chosen: stiffness === null },
  });
  restart();
}

function answer(question: Question): unknown {
  if (!simulator) return null;
  if (question.what === 'hash') return { hash: simulator.hash(), time: simulator.time() };
  return simulator.contacts(question.body);
}

function receive(message: ToWorker): void {
  switch (message.type) {
    case 'build':
      build(message);
      break;
    case 'hand':
      if (message.world === world) simulator?.want(message.wish);
      break;
    case 'pause':
      paused = message.paused;
      restart();
      break;
    case 'ask':
      send({ type: 'answer', id: message.id, value: answer(message.question) });
      break;
  }
}

function text(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** A fault of the engine leaves wasm memory in no known state: the world ends, and the page says so. */
function guard(action: () => void): void {
  try {
    action();
  } catch (error) {
    simulator = null;
    send({ type: 'failed', message: text(error) });
  }
}

load().then(
  exports => {
    memory = exports.memory;
    const list = JSON.parse(sceneList()) as SceneEntry[];
    self.onmessage = (event: MessageEvent<ToWorker>) => guard(() => receive(event.data));
    send({ type: 'scenes', list });
  },
  (error: unknown) => send({ type: 'failed', message: `the engine did not load (${text(error)})` }),
);
