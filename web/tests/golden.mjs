// The golden runs on the wasm face: the files of data/golden, played by a build of crates/wasm. Run
// as a program it prints the cells of the matrix, a line each: build, run, step of rest (- for
// none) and hash, with tabs between.

import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { BUILDS, load } from './engine.mjs';

const data = name => readFile(new URL(`../../data/golden/${name}`, import.meta.url), 'utf8');

/** The results that every build must give. */
export const golden = async () => JSON.parse(await data('hashes.json')).runs;

/** Plays all runs on a build: [{ name, step_of_rest, hash }]. */
export async function play(build) {
  const { Game, Simulation, namedScene } = await load(build);
  const outcomes = [];
  for (const run of JSON.parse(await data('runs.json'))) {
    const { name, scene, stiffness, form, springs, params, steps, inputs, commands } = run;
    const file = inputs ?? commands;
    const lines = file ? (await data(file)).split('\n') : [];
    const start = { ...JSON.parse(namedScene(scene)), form, springs };
    start.stiffness = stiffness ?? start.stiffness;
    const simulation = new (commands ? Game : Simulation)(JSON.stringify(start), JSON.stringify(params ?? {}));
    let rest = null;
    for (let i = 0; i < steps; i++) {
      const result = JSON.parse(simulation.step(lines[i] ?? ''));
      const { awake } = commands ? result.report : result;
      rest = awake > 0 ? null : (rest ?? i + 1);
    }
    outcomes.push({ name, step_of_rest: rest, hash: simulation.hash() });
    simulation.free();
  }
  return outcomes;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  for (const build of Object.keys(BUILDS)) {
    for (const { name, step_of_rest, hash } of await play(build))
      console.log(`wasm, ${build}\t${name}\t${step_of_rest ?? '-'}\t${hash}`);
  }
}
