// Particles and springs inside the blocks, and the strain that follows from them.
//
// A block is drawn as the affine map that fits its particles best, which its surfaces follow in the
// engine as well. The map is stored as the rotation of the pose and a strain in the block's own
// frame, which are interpolated separately.

import { POSE_STRIDE } from '../engine/game-protocol';

/** Particles per block. Bit k of a particle's index is its side of axis k. */
export const PARTICLES = 8;
/** Springs per block: one between each two particles. */
export const SPRINGS = 28;
/**
 * Numbers per body in a lattice array: positions of its particles (m, world), then forces of its
 * springs (N, positive in tension).
 */
export const LATTICE_STRIDE = 3 * PARTICLES + SPRINGS;
/** Numbers per body in a strain array: the columns of a matrix, the identity without strain. */
export const STRAIN_STRIDE = 9;

/** Particles that each spring joins, in the order of the forces. */
export const ENDS: readonly (readonly [number, number])[] = Array.from({ length: PARTICLES }, (_, i) =>
  Array.from({ length: PARTICLES - 1 - i }, (_, n) => [i, i + 1 + n] as const),
).flat();

/** Returns the strains of unstrained bodies. */
export function unstrained(count: number): Float32Array {
  const strains = new Float32Array(STRAIN_STRIDE * count);
  for (let body = 0; body < count; body++) for (let k = 0; k < 3; k++) strains[STRAIN_STRIDE * body + 4 * k] = 1;
  return strains;
}

/**
 * Returns the strain of each body: R⁻¹ F with F = Σ p_i s_ik / (8 g_k) for particle i at p_i, on
 * side s_ik of axis k, at distance g_k from the centre. `particleOffset`: g over half the edge.
 */
export function strains(
  lattices: Float32Array,
  poses: ArrayLike<number>,
  sizes: ArrayLike<number>,
  particleOffset: number,
): Float32Array {
  const count = sizes.length / 3;
  const all = new Float32Array(STRAIN_STRIDE * count);
  for (let body = 0; body < count; body++) {
    const from = body * LATTICE_STRIDE;
    const [x, y, z, w] = [3, 4, 5, 6].map(k => poses[body * POSE_STRIDE + k]);
    for (let k = 0; k < 3; k++) {
      // Column k of F.
      const scale = 1 / (4 * particleOffset * sizes[3 * body + k]);
      let [fx, fy, fz] = [0, 0, 0];
      for (let i = 0; i < PARTICLES; i++) {
        const side = (i >> k) & 1 ? scale : -scale;
        fx += side * lattices[from + 3 * i];
        fy += side * lattices[from + 3 * i + 1];
        fz += side * lattices[from + 3 * i + 2];
      }
      // Rotated into the block's frame by the conjugate: v + 2 w (v × q) + 2 q × (q × v).
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

/** Returns the largest displacement of a corner by strain along an axis of its body, m. */
export function maxDeformation(strains: Float32Array, sizes: ArrayLike<number>): number {
  let max = 0;
  for (let body = 0; 3 * body < sizes.length; body++) {
    for (let row = 0; row < 3; row++) {
      let displacement = 0;
      for (let k = 0; k < 3; k++) {
        const off = strains[STRAIN_STRIDE * body + 3 * k + row] - (k === row ? 1 : 0);
        displacement += Math.abs(off) * (sizes[3 * body + k] / 2);
      }
      max = Math.max(max, displacement);
    }
  }
  return max;
}

/** Returns the largest magnitude of a spring's force, N. */
export function maxForce(lattices: Float32Array): number {
  let max = 0;
  for (let at = 0; at < lattices.length; at++)
    if (at % LATTICE_STRIDE >= 3 * PARTICLES) max = Math.max(max, Math.abs(lattices[at]));
  return max;
}

/** Springs in the picture, interpolated between the last two states like the blocks. */
export class Lattices {
  private older: Float32Array | null = null;
  private newest: Float32Array | null = null;
  /** Springs in the picture; null where there are none. */
  shown: Float32Array | null = null;

  arrive(lattices: Float32Array | null): void {
    this.older = this.newest ?? lattices;
    this.newest = lattices;
  }

  /**
   * Sets the picture to fraction `t` between the older and the newer state; returns true if it
   * changed.
   */
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
      // Tolerance: a hundredth of a millimetre for positions, a hundredth of their value for
      // forces.
      const tolerance = at % LATTICE_STRIDE < 3 * PARTICLES ? 1e-5 : 1e-4 + 0.01 * Math.abs(shown[at]);
      if (Math.abs(value - shown[at]) <= tolerance) continue;
      shown[at] = value;
      changed = true;
    }
    return changed;
  }
}
