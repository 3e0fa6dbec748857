// The worker of one method in the plane: steps it at the chosen speed where the device can, and
// sends one message a frame.

import { FRAME } from '../engine/game-protocol';
import { Loop } from '../engine/loop';
import { Speedometer } from '../engine/pacing';
import { errorText, guarded, unlessRefused } from '../engine/worker-errors';
import load, { Plane } from '../wasm/teeter_museum.js';
import { readToPlane } from './message-reader';
import type { FromPlane, PlaneCounts, PlaneSetup, ToPlane } from './protocol';

/** Largest time for the steps of one frame, s: steps beyond it are dropped. */
const BUDGET = 0.012;

const seconds = () => performance.now() / 1000;
const send = (message: FromPlane, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

let memory: WebAssembly.Memory;
let plane: Plane | null = null;
let scene = 0;
let speed = 0;
/** Simulated time that is due, s. */
let due = 0;
const meter = new Speedometer();
const guard = guarded(message => {
  plane = null;
  send({ type: 'failed', message });
});
const loop = new Loop(seconds, () => plane !== null && speed > 0, advance, guard);

function advance(): void {
  const { step } = plane!;
  const [before, start] = [plane!.time(), seconds()];
  due += FRAME * speed;
  while (due >= step && seconds() - start < BUDGET) {
    plane!.advance(1);
    due -= step;
  }
  due = Math.min(due, step);
  const end = seconds();
  meter.add(end, plane!.time() - before, end - start);
  show();
}

function show(): void {
  const length = 8 * plane!.length;
  const at = plane!.cornersPtr();
  const corners = Float32Array.from(new Float64Array(memory.buffer, at, length));
  const contacts = Float32Array.from(plane!.contacts());
  const held = Float32Array.from(plane!.held());
  const counts = JSON.parse(plane!.report()) as PlaneCounts;
  const factor = speed > 0 ? meter.factor() : 0;
  send({ type: 'frame', scene, corners, contacts, held, counts, factor }, [
    corners.buffer,
    contacts.buffer,
    held.buffer,
  ]);
}

function restart(): void {
  due = 0;
  meter.restart();
  loop.restart();
}

/** Builds a scene; where that fails the previous one goes on. */
function build(number: number, setup: PlaneSetup): void {
  const next = new Plane(JSON.stringify(setup));
  plane?.free();
  plane = next;
  scene = number;
  show();
  restart();
}

/** Carries out a message. One that cannot be read or met changes nothing. */
function receive(data: unknown): void {
  let message: ToPlane;
  try {
    message = readToPlane(data);
  } catch (error) {
    send({ type: 'invalid', message: errorText(error) });
    return;
  }
  unlessRefused(
    () => carryOut(message),
    reason => send({ type: 'refused', message: reason }),
  );
}

function carryOut(message: ToPlane): void {
  switch (message.type) {
    case 'build':
      build(message.scene, message.setup);
      break;
    case 'speed':
      speed = message.speed;
      restart();
      break;
    case 'single':
      plane?.advance(1);
      if (plane) show();
      break;
    case 'hold':
      plane?.hold(message.x, message.y);
      break;
    case 'drag':
      plane?.drag(message.x, message.y);
      break;
    case 'release':
      plane?.release();
      break;
    case 'add':
      plane?.add(message.x, message.y, message.vx, message.vy);
      if (plane && speed === 0) show();
      break;
  }
}

// Messages that come before the module is loaded wait.
const early: unknown[] = [];
self.onmessage = (event: MessageEvent<unknown>) => void early.push(event.data);
load().then(
  exports => {
    memory = exports.memory;
    self.onmessage = (event: MessageEvent<unknown>) => guard(() => receive(event.data));
    for (const message of early) guard(() => receive(message));
  },
  (error: unknown) => send({ type: 'failed', message: `the simulator did not load (${errorText(error)})` }),
);
