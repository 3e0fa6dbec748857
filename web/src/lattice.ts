// What the worker tells of the springs inside the blocks, and what follows from it: how a block is strained, and how hard each spring pulls.
//
// A block is drawn as the affine map that fits its particles best, which is also what its surfaces follow in the engine. The map is kept as
// a turn (the pose) and a strain in the block's own frame: between two states the one is blended as a turn, the other number by number.

import { POSE_STRIDE } from './protocol';

/** Particles of a block. Bit k of a particle's number says on which side of axis k it is. */
export const PARTICLES = 8;
/** Springs of a block: one between each two particles. */
export const SPRINGS = 28;
/** Numbers a body in a lattice array: the places of its particles (m, in the world), then the forces of its springs (N, pulling is positive). */
export const LATTICE_STRIDE = 3 * PARTICLES + SPRINGS;
/** Numbers a body in a strain array: the columns of a matrix, which is one where nothing is strained. */
export const STRAIN_STRIDE = 9;

/** The particles that each spring joins, in the order of the forces. */
export const ENDS: readonly (readonly [number, number])[] = Array.from({ length: PARTICLES }, (_, i) =>
  Array.from({ length: PARTICLES - 1 - i }, (_, n) => [i, i + 1 + n] as const),
).flat();

/** An array of strains of bodies that are as they were made. */
export function unstrained(count: number): Float32Array {
  const strains = new Float32Array(STRAIN_STRIDE * count);
  for (let body = 0; body < count; body++) for (let k = 0; k < 3; k++) strains[STRAIN_STRIDE * body + 4 * k] = 1;
  return strains;
}

/**
 * How bodies are strained, from their particles: R⁻¹ F with F = Σ p_i s_ik / (8 g_k) for particle i at p_i, on side s_ik of axis k, at g_k
 * from the centre. `place`: g over half the edge.
 */
export function strains(
  lattices: Float32Array,
  poses: ArrayLike<number>,
  sizes: ArrayLike<number>,
  place: number,
): Float32Array {
  const count = sizes.length / 3;
  const all = new Float32Array(STRAIN_STRIDE * count);
  for (let body = 0; body < count; body++) {
    const from = body * LATTICE_STRIDE;
    const [x, y, z, w] = [3, 4, 5, 6].map(k => poses[body * POSE_STRIDE + k]);
    for (let k = 0; k < 3; k++) {
      // Column k of F.
      const scale = 1 / (4 * place * sizes[3 * body + k]);
      let [fx, fy, fz] = [0, 0, 0];
      for (let i = 0; i < PARTICLES; i++) {
        const side = (i >> k) & 1 ? scale : -scale;
        fx += side * lattices[from + 3 * i];
        fy += side * lattices[from + 3 * i + 1];
        fz += side * lattices[from + 3 * i + 2];
      }
      // Into the block's frame: v + 2 w (v × q) + 2 q × (q × v), the turn by the conjugate.
      const cx = fy * z - fz * y;
      const cy = fz * x - fx * z;
      const cz = fx * y - fy * x;
      const at = body * STRAIN_STRIDE + 3 * k;
      all[at] = fx + 2 * (w * cx - (y * cz - z * cy));
      all[at + 1] = fy + 2 * (w * cy - (z * cx - x * cz));
      all[at + 2] = fz + 2 * (w * cz - (x * cy - y * cx));
    }
  }
  return all;
}

/** The farthest that strain moves a corner of any body along an axis of its own, m. */
export function farthest(strains: Float32Array, sizes: ArrayLike<number>): number {
  let most = 0;
  for (let body = 0; 3 * body < sizes.length; body++) {
    for (let row = 0; row < 3; row++) {
      let way = 0;
      for (let k = 0; k < 3; k++) {
        const off = strains[STRAIN_STRIDE * body + 3 * k + row] - (k === row ? 1 : 0);
        way += Math.abs(off) * (sizes[3 * body + k] / 2);
      }
      most = Math.max(most, way);
    }
  }
  return most;
}

/** The greatest force of any spring, either way, N. */
export function greatest(lattices: Float32Array): number {
  let most = 0;
  for (let at = 0; at < lattices.length; at++)
    if (at % LATTICE_STRIDE >= 3 * PARTICLES) most = Math.max(most, Math.abs(lattices[at]));
  return most;
}

/** The springs in the picture: between the last two states, as the blocks are. */
export class Lattices {
  private older: Float32Array | null = null;
  private newest: Float32Array | null = null;
  /** The state in the picture; null where nothing is known of springs. */
  shown: Float32Array | null = null;

  arrive(lattices: Float32Array | null): void {
    this.older = this.newest ?? lattices;
    this.newest = lattices;
  }

  /** Sets the picture to the place `t` between the older and the newer state; whether it differs from the one before. */
  blend(t: number): boolean {
    const { older, newest } = this;
    if (!older || !newest) {
      const had = this.shown !== null;
      this.shown = null;
      return had;
    }
    let changed = this.shown?.length !== newest.length;
    if (changed) this.shown = new Float32Array(newest.length);
    const shown = this.shown!;
    for (let at = 0; at < newest.length; at++) {
      const value = older[at] + t * (newest[at] - older[at]);
      // Places to a hundredth of a millimetre, forces to a part of what they are.
      const least = at % LATTICE_STRIDE < 3 * PARTICLES ? 1e-5 : 1e-4 + 0.01 * Math.abs(shown[at]);
      if (Math.abs(value - shown[at]) <= least) continue;
      shown[at] = value;
      changed = true;
    }
    return changed;
  }
}
