// Scenes as the page hands them to the engine.

import { namedScene, towerScene } from '../wasm/teeter_wasm.js';
import type { Form } from './game-protocol';
import type { SceneSource } from './protocol';

/** Fields of a scene that the page reads or sets. */
interface Scene {
  blocks: unknown[];
  stiffness: number;
  form?: Form;
  springs?: { stiffness?: number; damping?: number; particles?: 'inside' | 'corners' };
}

/** Blocks as a scene itself describes them. */
export interface SceneDefaults {
  blocks: number;
  form: Form | null;
  /** Stiffness of the springs inside the blocks, N/m; null for that of the contacts. */
  springs: number | null;
}

/** Blocks and contacts that a scene is built with. Stiffness is that of the contacts, N/m. */
export interface Choice {
  form: Form;
  stiffness: number;
  springs: number | null;
}

/** Distance of the particles from a block's centre along each axis, over half the edge. */
export function particleOffset(scene: string): number {
  const { springs } = JSON.parse(scene) as Scene;
  return springs?.particles === 'corners' ? 1 : 1 / Math.sqrt(3);
}

/** Source of a scene that is built, as opposed to recorded. */
export type BuiltSource = Exclude<SceneSource, { bytes: Uint8Array }>;

function textOf(source: BuiltSource): string {
  switch (source.kind) {
    case 'named':
      return namedScene(source.name);
    case 'scene':
      return source.text;
    case 'tower':
      return towerScene(JSON.stringify({ rows: source.rows, seed: source.seed, block: source.block }));
  }
}

/**
 * Returns the scene as JSON with what `choose` returns.
 * Throws an Error whose message is for the user.
 */
export function sceneText(source: BuiltSource, choose: (defaults: SceneDefaults) => Choice): string {
  const scene = JSON.parse(textOf(source)) as Scene;
  const { form, stiffness, springs } = choose({
    blocks: scene.blocks.length,
    // A scene that names no form has rigid blocks, but leaves the choice open.
    form: scene.form === 'lattice' ? scene.form : null,
    springs: scene.springs?.stiffness ?? null,
  });
  scene.stiffness = stiffness;
  scene.form = form;
  scene.springs = { ...scene.springs, stiffness: springs ?? undefined };
  return JSON.stringify(scene);
}
