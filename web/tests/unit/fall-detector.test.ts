// Standing, moving, fallen: told from poses, and what the player does with a block in the hand is no fall.

import { Vector3 } from 'three';
import { expect, test } from 'vitest';
import type { Bodies } from '../../src/view/bodies';
import { LATTICE_STRIDE, PARTICLES } from '../../src/view/lattice';
import { settlement } from '../../src/hand/control/settlement';
import { FallDetector } from '../../src/hand/control/fall-detector';
import { SIZE, tower } from './towers';

test('a block that comes down by itself has fallen, and stays fallen', () => {
  const bodies = tower(['xxx', 'xxx']);
  const detector = new FallDetector(bodies.newest);
  expect(detector.advance(bodies.newest, 0, 0, null)).toBe('standing');
  expect(detector.advance(bodies.newest, 0.1, 0.02, null)).toBe('moving');
  const down = bodies.newest.slice();
  down[5 * 7 + 2] -= 0.004;
  expect(detector.advance(down, 0.2, 0, null)).toBe('standing');
  down[5 * 7 + 2] -= 0.002;
  expect(detector.advance(down, 0.3, 0.1, null)).toBe('fallen');
  expect(detector.advance(bodies.newest, 0.4, 0, null)).toBe('fallen');
  expect(detector.bodies.length).toBe(1);
});

test('a block put on the table by the hand is no fall, others that fall with it are', () => {
  const bodies = tower(['xxx', 'xxx']);
  const detector = new FallDetector(bodies.newest);
  const poses = bodies.newest.slice();
  detector.advance(poses, 1, 0.1, 4);
  poses[4 * 7 + 2] = 0.009;
  expect(detector.advance(poses, 1.5, 0.1, null)).toBe('moving');
  expect(detector.advance(poses, 4, 0, null)).toBe('standing');
  poses[3 * 7 + 2] = 0.009;
  expect(detector.advance(poses, 4.1, 0, null)).toBe('fallen');
});

/** The particles of blocks whose height is that part of what it was. */
function squashed(bodies: Bodies, part: number): Float32Array {
  const lattices = new Float32Array(LATTICE_STRIDE * bodies.count);
  for (let body = 0; body < bodies.count; body++) {
    for (let i = 0; i < PARTICLES; i++) {
      const side = new Vector3(...([0, 1, 2] as const).map(k => ((i >> k) & 1 ? 0.5 : -0.5) / Math.sqrt(3)));
      const position = side.multiply(bodies.size(body)).multiply(new Vector3(1, 1, part));
      bodies.toWorld(body, position, bodies.newest).toArray(lattices, LATTICE_STRIDE * body + 3 * i);
    }
  }
  return lattices;
}

test('a tower of soft blocks that sinks has not fallen, and a block that falls from it has', () => {
  const bodies = tower(Array.from({ length: 18 }, () => 'xxx'));
  const detector = new FallDetector(bodies.newest);
  expect(settlement(bodies, detector.heights)).toBeNull();
  const poses = bodies.newest.map((x, i) => (i % 7 === 2 ? 0.9 * x : x));
  bodies.arrive(poses);
  bodies.arrive(poses, squashed(bodies, 0.9));
  const sunk = settlement(bodies, detector.heights)!;
  expect(sunk[53], 'of the top row, m').toBeCloseTo(0.1 * 17.5 * SIZE.z, 5);
  expect(sunk[0], 'of the lowest, m').toBeCloseTo(0.05 * SIZE.z, 5);
  expect(detector.advance(poses, 1, 0, null, sunk)).toBe('standing');
  const down = poses.slice();
  down[53 * 7 + 2] -= 0.006;
  expect(detector.advance(down, 1.1, 0, null, sunk)).toBe('fallen');
  expect(detector.bodies.length).toBe(1);
});
