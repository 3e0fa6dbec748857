// A worker that does one job after another, a step at a time, so that it can be stopped.

import load, * as engine from '../wasm/teeter_wasm.js';
import { MoveCut } from './move-cut';
import { verification } from './verification';
import { errorText } from '../engine/worker-errors';
import { jobId, readStudyMessage } from './job-reader';
import type { FromStudy, Job, RecordReport, ToStudy } from './jobs';

/** Time between two reports of the progress, ms. */
const INTERVAL = 60;
/** Seed of the errors of analyses. */
const SEED = 1;

interface Task {
  /** True once the result counts although the work is not done. */
  isUsable?(): boolean;
  /** Returns the part of the work that is done; 1 at the end. */
  step(): number;
  result(): unknown;
  free(): void;
}

const send = (message: FromStudy) => self.postMessage(message);
const stopped = new Set<number>();
let memory: WebAssembly.Memory;
let queue: Promise<void> = load().then(exports => {
  memory = exports.memory;
});

function taskOf(job: Job): Task | Promise<Task> {
  switch (job.kind) {
    case 'think':
      return thought(new engine.Thought(job.state, job.question));
    case 'tower':
      return tower(new engine.TowerAnalysis(job.state, job.rules, SEED, job.budget));
    case 'record':
      return record(new engine.RecordAnalysis(job.bytes, SEED, job.budget));
    case 'verify':
      return verification(job.bytes, { engine, memory }, new URL(job.engines), job.setup);
    case 'cut':
      return new MoveCut(job.move);
  }
}

function thought(task: engine.Thought): Task {
  return {
    step: () => task.step(),
    // Blocks are ranked before they are tried.
    isUsable: () => task.considered() !== '[]',
    result: () => JSON.parse(task.considered()) as unknown,
    free: () => task.free(),
  };
}

function tower(task: engine.TowerAnalysis): Task {
  return { step: () => task.step(), result: () => JSON.parse(task.blocks()) as unknown, free: () => task.free() };
}

function record(task: engine.RecordAnalysis): Task {
  const report = () => JSON.parse(task.report()) as RecordReport;
  return {
    step: () => task.step(),
    // A plot needs at least one trial of each move.
    isUsable: () => {
      const { moves } = report();
      return moves.length > 0 && moves.every(({ rollouts }) => rollouts > 0);
    },
    result: report,
    free: () => task.free(),
  };
}

async function run(id: number, job: Job): Promise<void> {
  const end = performance.now() + job.seconds * 1000;
  const task = await taskOf(job);
  try {
    let reported = performance.now();
    const isTimeUp = () => performance.now() >= end && (task.isUsable?.() ?? true);
    for (let part = 0; part < 1 && !isTimeUp() && !stopped.has(id); part = task.step()) {
      if (performance.now() - reported < INTERVAL) continue;
      reported = performance.now();
      send({ type: 'progress', id, part });
      // Messages are taken in between.
      await new Promise(resolve => setTimeout(resolve));
    }
    send({ type: 'result', id, value: task.result() });
  } finally {
    task.free();
    stopped.delete(id);
  }
}

/** Carries out a message, or answers why it cannot. */
function receive(data: unknown): void {
  const failed = (id: number | null) => (error: unknown) => send({ type: 'failed', id, message: errorText(error) });
  let message: ToStudy;
  try {
    message = readStudyMessage(data);
  } catch (error) {
    failed(jobId(data))(error);
    return;
  }
  const { id } = message;
  if (message.type === 'stop') stopped.add(id);
  else {
    const { job } = message;
    queue = queue.then(() => run(id, job)).catch(failed(id));
  }
}

self.onmessage = ({ data }: MessageEvent<unknown>) => receive(data);
