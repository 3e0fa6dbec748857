// Strain from particles: that of a block, whatever its position and orientation, and the picture
// between two states.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { Bodies } from '../../src/view/bodies';
import { pick } from '../../src/view/picking';
import {
  ENDS,
  maxDeformation,
  maxForce,
  LATTICE_STRIDE,
  Lattices,
  PARTICLES,
  SPRINGS,
  strains,
  unstrained,
} from '../../src/view/lattice';
import { SIZE } from './towers';

const OFFSET = 1 / Math.sqrt(3);
const AT = new Vector3(0.02, -0.03, 0.2);
const TURN = new Quaternion(0.3, -0.2, 0.5, 0.7).normalize();
const POSE = Float32Array.from([...AT.toArray(), ...TURN.toArray()]);
const SIZES = Float32Array.from(SIZE.toArray());

/**
 * The particles of a block at AT with TURN which `strain` has moved in its frame, and no
 * forces.
 */
function particles(strain: (p: Vector3) => Vector3): Float32Array {
  const lattice = new Float32Array(LATTICE_STRIDE);
  for (let i = 0; i < PARTICLES; i++) {
    const side = new Vector3(...([0, 1, 2] as const).map(k => ((i >> k) & 1 ? 1 : -1)));
    const position = side.multiply(SIZE).multiplyScalar(OFFSET / 2);
    strain(position)
      .applyQuaternion(TURN)
      .add(AT)
      .toArray(lattice, 3 * i);
  }
  return lattice;
}

const COMPRESSED = (p: Vector3) => new Vector3(1.02 * p.x + 0.1 * p.z, 1.05 * p.y, 0.8 * p.z);

test('28 springs join 8 particles, each pair once', () => {
  expect(ENDS.length).toBe(SPRINGS);
  expect(new Set(ENDS.map(([i, j]) => 8 * i + j)).size).toBe(SPRINGS);
  expect(ENDS[0]).toEqual([0, 1]);
  expect(ENDS[27]).toEqual([6, 7]);
  for (const [i, j] of ENDS) expect(i).toBeLessThan(j);
});

test('the strain is found in the frame of the block, whatever its position and orientation', () => {
  const none = strains(
    particles(p => p),
    POSE,
    SIZES,
    OFFSET,
  );
  unstrained(1).forEach((one, n) => expect(none[n], `number ${n}`).toBeCloseTo(one, 5));
  const found = strains(particles(COMPRESSED), POSE, SIZES, OFFSET);
  [1.02, 0, 0, 0, 1.05, 0, 0.1, 0, 0.8].forEach((value, n) => expect(found[n], `number ${n}`).toBeCloseTo(value, 5));
});

test('the largest displacement of a corner along an axis, and nothing without strain', () => {
  expect(maxDeformation(unstrained(2), [...SIZES, ...SIZES])).toBe(0);
  const strain = strains(particles(COMPRESSED), POSE, SIZES, OFFSET);
  expect(maxDeformation(strain, SIZES)).toBeCloseTo(0.2 * 0.009, 6);
});

test('the surface of a block is that of its particles, and the hand holds it by its pose', () => {
  const bodies = new Bodies(SIZES, POSE, OFFSET);
  for (let i = 0; i < 2; i++) bodies.arrive(POSE, particles(COMPRESSED));
  bodies.blend(1);
  const corner = SIZE.clone().multiplyScalar(0.5);
  const wanted = COMPRESSED(corner).applyQuaternion(TURN).add(AT);
  expect(bodies.surface(0, corner).distanceTo(wanted)).toBeLessThan(1e-7);
  expect(bodies.toWorld(0, corner).distanceTo(corner.clone().applyQuaternion(TURN).add(AT))).toBeLessThan(1e-7);
  const up = new Vector3(0, 0, 1).applyQuaternion(TURN);
  expect(bodies.halfExtent(0, up)).toBeCloseTo(0.4 * SIZE.z, 6);
});

test('a ray meets the compressed top where it is, and the anchor is that point in the pose', () => {
  const bodies = new Bodies(SIZES, POSE, OFFSET);
  for (let i = 0; i < 2; i++) bodies.arrive(POSE, particles(COMPRESSED));
  bodies.blend(1);
  const up = new Vector3(0, 0, 1).applyQuaternion(TURN);
  const hit = pick(bodies, AT.clone().addScaledVector(up, 0.3), up.clone().negate())!;
  expect(hit.distance).toBeCloseTo(0.3 - 0.4 * SIZE.z, 6);
  expect(hit.normal.angleTo(up), 'a shear along the top leaves it level').toBeLessThan(1e-6);
  expect(bodies.toWorld(0, hit.anchor).distanceTo(hit.point)).toBeLessThan(1e-7);
  expect(hit.anchor.z).toBeCloseTo(0.4 * SIZE.z, 6);
  expect(pick(bodies, AT.clone().addScaledVector(up, 0.3), up)).toBeNull();
});

test('the picture is between two states, and springs that go away go at once', () => {
  const lattices = new Lattices();
  expect(lattices.blend(0.5)).toBe(false);
  const [a, b] = [particles(p => p), particles(p => p)];
  b[24] = 2;
  lattices.arrive(a);
  expect(lattices.blend(1)).toBe(true);
  expect(lattices.blend(1), 'the same state again').toBe(false);
  lattices.arrive(b);
  expect(lattices.blend(0.25)).toBe(true);
  expect(lattices.shown![24]).toBeCloseTo(0.5, 6);
  expect(maxForce(lattices.shown!)).toBeCloseTo(0.5, 6);
  lattices.arrive(null);
  expect(lattices.blend(0.25)).toBe(true);
  expect(lattices.shown).toBeNull();
});

test('the largest force is of a spring, never a position', () => {
  const lattice = particles(p => p.multiplyScalar(100));
  lattice[LATTICE_STRIDE - 1] = -0.3;
  expect(maxForce(lattice)).toBeCloseTo(0.3, 6);
});
