// The builds of crates/wasm, loaded under node.

import { readFile } from 'node:fs/promises';

const root = new URL('../../', import.meta.url);

/** Folders of the builds. */
export const BUILDS = { simd128: 'web/src/wasm/', scalar: 'web/wasm-scalar/' };

/** The wasm of a build, as bytes. */
export async function bytes(build) {
  try {
    return await readFile(new URL(`${BUILDS[build]}teeter_wasm_bg.wasm`, root));
  } catch {
    throw new Error(`${BUILDS[build]} is missing: run tools/build-wasm${build === 'scalar' ? ' scalar' : ''}`);
  }
}

/** The face of a build, ready for use. */
export async function load(build) {
  const module_or_path = await bytes(build);
  const face = await import(new URL(`${BUILDS[build]}teeter_wasm.js`, root).href);
  await face.default({ module_or_path });
  return face;
}
