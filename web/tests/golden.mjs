// The golden runs on the wasm face: the files of data/golden, played by a build of crates/wasm. Run as a program it prints the cells of
// the matrix, a line each: build, run, step of rest (- for none) and hash, with tabs between.

import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

const root = new URL('../../', import.meta.url);
const data = name => readFile(new URL(`data/golden/${name}`, root), 'utf8');

/** Folders of the builds. */
export const BUILDS = { simd128: 'web/src/wasm/', scalar: 'web/wasm-scalar/' };

/** The results that every build must give. */
export const golden = async () => JSON.parse(await data('hashes.json')).runs;

/** The wasm of a build, as bytes. */
export async function bytes(build) {
  try {
    return await readFile(new URL(`${BUILDS[build]}teeter_wasm_bg.wasm`, root));
  } catch {
    throw new Error(`${BUILDS[build]} is missing: run tools/build-wasm${build === 'scalar' ? ' scalar' : ''}`);
  }
}

/** Plays all runs on a build: [{ name, step_of_rest, hash }]. */
export async function play(build) {
  const module_or_path = await bytes(build);
  const { default: init, Simulation, namedScene } = await import(new URL(`${BUILDS[build]}teeter_wasm.js`, root).href);
  await init({ module_or_path });
  const outcomes = [];
  for (const { name, scene, stiffness, params, steps, inputs } of JSON.parse(await data('runs.json'))) {
    const lines = inputs ? (await data(inputs)).split('\n') : [];
    const start = JSON.parse(namedScene(scene));
    start.stiffness = stiffness ?? start.stiffness;
    const simulation = new Simulation(JSON.stringify(start), JSON.stringify(params ?? {}));
    let rest = null;
    for (let i = 0; i < steps; i++) {
      const { awake } = JSON.parse(simulation.step(lines[i] ?? ''));
      rest = awake > 0 ? null : (rest ?? i + 1);
    }
    outcomes.push({ name, step_of_rest: rest, hash: simulation.hash() });
    simulation.free();
  }
  return outcomes;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  for (const build of Object.keys(BUILDS)) {
    for (const { name, step_of_rest, hash } of await play(build)) console.log(`wasm, ${build}\t${name}\t${step_of_rest ?? '-'}\t${hash}`);
  }
}
