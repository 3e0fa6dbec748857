// Workloads of benches/cost on the wasm face. As a program (`node cost.mjs BUILD`) it is the other
// end of benches/cost/src/node.rs: it takes JSON lines from its standard input and answers each
// with one on its standard output, errors on standard error and the exit code.
//
// {"prepare": {"scene", "params", "inputs", "settle", "frames"}}  ->  the number of the workload,
// from 0 {"play": number}                                                ->  {"cpu", "frames",
// "hash"}, times in ms
//
// An input is the text that a step takes; nothing acts after the last.

import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { BUILDS, load } from './engine.mjs';

/** A workload that is played again and again from its first measured frame. */
export class Clocked {
  #simulation;
  #state;
  #inputs;

  /** Settles a workload. */
  constructor({ Simulation }, { scene, params, inputs, settle, frames }) {
    this.#simulation = new Simulation(JSON.stringify(scene), JSON.stringify(params));
    for (let i = 0; i < settle; i++) this.#simulation.step(inputs[i] ?? '');
    this.#state = this.#simulation.snapshot();
    this.#inputs = Array.from({ length: frames }, (_, i) => inputs[settle + i] ?? '');
  }

  /**
   * Plays the measured frames: processor time of all of them and time of each by the clock on the
   * wall, ms, and the hash at the end.
   */
  play() {
    this.#simulation.restore(this.#state);
    const cpu = process.cpuUsage();
    const frames = this.#inputs.map(input => {
      const start = performance.now();
      this.#simulation.step(input);
      return performance.now() - start;
    });
    const { user, system } = process.cpuUsage(cpu);
    return { cpu: 1e-3 * (user + system), frames, hash: this.#simulation.hash() };
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const build = process.argv[2];
  if (!(build in BUILDS)) throw new Error(`expected ${Object.keys(BUILDS).join(' or ')}, not ${build}`);
  const face = await load(build);
  const workloads = [];
  for await (const line of createInterface({ input: process.stdin })) {
    const { prepare, play } = JSON.parse(line);
    const answer = prepare ? workloads.push(new Clocked(face, prepare)) - 1 : workloads[play].play();
    console.log(JSON.stringify(answer));
  }
}
