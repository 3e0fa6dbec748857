// The worker: owns the world, keeps it in step with the wall clock, and sends one message a step.

import { Device } from './device';
import { guarded, text } from './fault';
import { Loop } from './loop';
import { Speedometer } from './pacing';
import { FRAME, type FromWorker, type Question, type SceneEntry, type ToWorker } from './protocol';
import { Simulator, sceneText, type Step } from './simulator';
import { Stillness } from './stillness';
import { trial } from './trial';
import load, { sceneList } from './wasm/teeter_wasm.js';

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

let memory: WebAssembly.Memory;
let simulator: Simulator | null = null;
let world = 0;
let paused = false;
/** Whether the springs are looked at. */
let watched = false;
/** Whether the X-ray is. */
let xrayed = false;
/** The last step of the world. */
let last: Step | null = null;
const speedometer = new Speedometer();
const stillness = new Stillness();
const device = new Device(form => trial(form, seconds));
const guard = guarded(message => {
  simulator = null;
  send({ type: 'failed', message });
});
const loop = new Loop(
  seconds,
  () => simulator !== null && !paused,
  () => step(simulator!),
  guard,
);

function step(simulator: Simulator): void {
  const before = seconds();
  last = simulator.step();
  const after = seconds();
  const cost = after - before;
  speedometer.add(after, FRAME, cost);
  device.played(cost, simulator.length, simulator.stiffness, simulator.form, simulator.springStiffness);
  show(simulator, last);
  const { report, hand } = last;
  const { form, springStiffness: springs } = simulator;
  // The forces in the contacts are known after every step: to sum them is next to nothing beside it.
  if (stillness.advance({ speed: report.max_speed, held: hand !== null, form, springs }, () => simulator.xray()))
    showXRay(simulator);
}

function showXRay(simulator: Simulator): void {
  if (xrayed) send({ type: 'xray', world, forces: stillness.still ? simulator.xray() : null });
}

function show(simulator: Simulator, step: Step): void {
  const lattices = simulator.lattices(watched);
  const told = simulator.told(step);
  send(
    {
      type: 'frame',
      world,
      ...told,
      factor: speedometer.factor(),
      capacity: speedometer.capacity(),
      springs: simulator.springStiffness,
      lattices,
    },
    lattices ? [told.poses.buffer, lattices.buffer] : [told.poses.buffer],
  );
}

function restart(): void {
  speedometer.restart();
  loop.restart();
}

/** Builds the world that is asked for; where that fails the old one goes on. */
function build(order: Extract<ToWorker, { type: 'build' }>): void {
  const { source, sleep, stiffness, form, springs } = order.setup;
  let next: Simulator;
  let chosen = false;
  try {
    const scene = sceneText(source, own => {
      const wanted = { stiffness, form: form ?? own.form, springs: springs ?? own.springs };
      chosen = wanted.form === null;
      return { ...device.choose(own.blocks, wanted), springs: wanted.springs };
    });
    next = new Simulator(scene, sleep, memory);
  } catch (error) {
    send({ type: 'refused', world: order.world, message: text(error) });
    return;
  }
  simulator?.free();
  simulator = next;
  last = null;
  world = order.world;
  device.begin();
  stillness.restart();
  send({
    type: 'built',
    world,
    sizes: next.sizes(),
    poses: next.poses(),
    stiffness: { value: next.stiffness, chosen: stiffness === null },
    form: { value: next.form, chosen },
    springs: next.springStiffness,
    place: next.place,
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
    case 'form':
      if (message.world === world) simulator?.become(message.form, message.springs);
      break;
    case 'watch':
      watched = message.springs;
      xrayed = message.xray;
      if (simulator) showXRay(simulator);
      // While time stands still no frame would come to show them.
      if (paused && simulator && last) show(simulator, { ...last, handDone: false });
      break;
    case 'ask':
      send({ type: 'answer', id: message.id, value: answer(message.question) });
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
  (error: unknown) => send({ type: 'failed', message: `the engine did not load (${text(error)})` }),
);
