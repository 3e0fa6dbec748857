// The museum's worker: owns the tower of 2003, the engine's, or both. Two towers take each step together and with the same wish, so the
// engine waits for the other, which needs by far the longer; the simulated time of both falls behind the clock where it must.

import { guarded, text } from '../fault';
import { Loop } from '../loop';
import { Speedometer } from '../pacing';
import { FRAME, type Frame, type FromWorker, type Question, type ToWorker, type Wish } from '../protocol';
import { Simulator, sceneText } from '../simulator';
import loadMuseum from '../wasm/teeter_museum.js';
import loadEngine from '../wasm/teeter_wasm.js';
import { Old } from './old';
import type { MuseumFrame, Order } from './protocol';

/** Stiffness of the engine's contacts, N/m. */
const STIFFNESS = 1e6;

const seconds = () => performance.now() / 1000;
const send = (message: FromWorker | MuseumFrame, transfer: Transferable[] = []) =>
  self.postMessage(message, { transfer });

let memory: { engine: WebAssembly.Memory; old: WebAssembly.Memory };
let engine: Simulator | null = null;
let old: Old | null = null;
let world = 0;
let paused = false;
/** Of simulated time, and of what each tower costs. */
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

function step(): void {
  const before = seconds();
  const of = {
    old: old && timed(speed.old, () => old!.step()),
    engine: engine && timed(speed.engine, () => engine!.step()),
  };
  const after = seconds();
  speed.all.add(after, FRAME, after - before);
  const shared = {
    type: 'frame',
    world,
    factor: speed.all.factor(),
    capacity: speed.all.capacity(),
    costs: { old: old && FRAME / speed.old.capacity(), engine: engine && FRAME / speed.engine.capacity() },
    old: of.old?.report ?? null,
    springs: null,
  } as const satisfies Partial<MuseumFrame>;
  const told = old && { poses: old.poses(), lattices: old.lattices() };
  let frame: MuseumFrame;
  if (of.engine) {
    frame = { ...shared, ...engine!.told(of.engine), lattices: null, ghost: told };
  } else {
    const { time, touching, maxSpeed, report, hand, handDone } = of.old!;
    const own: Omit<Frame, keyof typeof shared> = {
      time,
      ...told!,
      hand,
      handDone,
      awake: report.active,
      touching,
      penetration: 0,
      maxSpeed,
      quarantined: [],
      form: 'lattice',
    };
    frame = { ...shared, ...own, ghost: null };
  }
  const sent = [frame.poses, frame.lattices, frame.ghost?.poses, frame.ghost?.lattices].filter(array => array != null);
  send(
    frame,
    sent.map(array => array.buffer),
  );
}

function restart(): void {
  for (const meter of Object.values(speed)) meter.restart();
  loop.restart();
}

/** Builds what is asked for; where that fails the old towers go on. */
function build({ world: number, setup }: { world: number; setup: Order }): void {
  let next: { engine: Simulator | null; old: Old | null };
  try {
    const { rows, seed, show, future } = setup;
    const choose = () => ({ form: 'rigid', stiffness: STIFFNESS, springs: null }) as const;
    const scene = sceneText({ kind: 'tower', rows, seed, block: 'dissertation' }, choose);
    next = {
      old: show === 'engine' ? null : new Old(scene, future, memory.old),
      engine: show === 'old' ? null : new Simulator(scene, true, memory.engine),
    };
  } catch (error) {
    send({ type: 'refused', world: number, message: text(error) });
    return;
  }
  old?.free();
  engine?.free();
  ({ old, engine } = next);
  world = number;
  const shown = engine ?? old!;
  send({
    type: 'built',
    world,
    sizes: shown.sizes(),
    poses: shown.poses(),
    stiffness: { value: STIFFNESS, chosen: false },
    form: { value: engine ? 'rigid' : 'lattice', chosen: false },
    springs: null,
    // The particles of 2003 are the corners.
    place: 1,
  });
  restart();
}

function want(wish: Wish | null): void {
  old?.want(wish);
  engine?.want(wish);
}

function answer(question: Question): unknown {
  const shown = engine ?? old;
  if (!shown) return null;
  return question.what === 'contacts'
    ? shown.contacts(question.body)
    : { hash: engine?.hash() ?? '', time: engine?.time() ?? 0 };
}

function receive(message: ToWorker<Order>): void {
  if (message.type === 'build') build(message);
  else if (message.type === 'hand' && message.world === world) want(message.wish);
  else if (message.type === 'ask') send({ type: 'answer', id: message.id, value: answer(message.question) });
  else if (message.type === 'pause') {
    paused = message.paused;
    restart();
  }
}

Promise.all([loadEngine(), loadMuseum()]).then(
  ([ofEngine, ofOld]) => {
    memory = { engine: ofEngine.memory, old: ofOld.memory };
    self.onmessage = (event: MessageEvent<ToWorker<Order>>) => guard(() => receive(event.data));
    send({ type: 'scenes', list: [] });
  },
  (error: unknown) => send({ type: 'failed', message: `the simulators did not load (${text(error)})` }),
);
