export const BUILDS: { simd128: string; scalar: string };
export function bytes(build: keyof typeof BUILDS): Promise<Uint8Array>;
/** Loads a build under node. */
export function load(build: keyof typeof BUILDS): Promise<typeof import('../src/wasm/teeter_wasm.js')>;
