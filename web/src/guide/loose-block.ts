// A block that comes out with little force, and the end of it that faces the viewer.

import { Vector3 } from 'three';
import type { Stage } from '../app/stage';
import { readings } from '../xray/readings';
import { pick } from '../view/picking';

/** Length over which a block is drawn out, m. */
const PULL = 0.11;
/** Blocks left out at the bottom and at the top: two rows, or one of a low tower. */
const OUTER = 6;

export interface LooseBlock {
  body: number;
  /** Middle of its end, and a point beyond it, px. */
  at: { x: number; y: number };
  out: { x: number; y: number };
}

/** Returns the loosest block whose end faces the viewer; `forces` as of an X-ray. */
export function looseBlock(stage: Stage, forces: Float32Array): LooseBlock | null {
  const bodies = stage.bodies!;
  const outer = Math.min(OUTER, Math.floor(bodies.count / 4));
  const inner = [...readings(forces, bodies).entries()].slice(outer, bodies.count - outer);
  const loosest = inner.filter(([, { pull }]) => pull !== null).sort((a, b) => a[1].pull! - b[1].pull!);
  for (const [body] of loosest) {
    const end = endOf(stage, body);
    if (end) return { body, ...end };
  }
  return null;
}

/** Screen positions of the end of a block that faces the viewer; null where none is visible. */
export function endOf(stage: Stage, body: number): Omit<LooseBlock, 'body'> | null {
  const { orbit } = stage;
  const bodies = stage.bodies!;
  for (const side of [1, -1]) {
    const half = (side * bodies.size(body).x) / 2;
    const at = orbit.project(bodies.surface(body, new Vector3(half, 0, 0)));
    const isSeen = pick(bodies, orbit.camera.position, orbit.ray(at.x, at.y))?.body === body;
    // An end that faces the viewer is lower on the screen than the middle of the block.
    if (!isSeen || at.y <= orbit.project(bodies.position(body)).y) continue;
    return { at, out: orbit.project(bodies.surface(body, new Vector3(half + side * PULL, 0, 0))) };
  }
  return null;
}
