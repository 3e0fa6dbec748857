// What the hand asks for while it slides a block: along the block's own length, which leans with the tower.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { Bodies } from '../../src/bodies';
import { drawn, pick } from '../../src/boxes';
import type { Client } from '../../src/client';
import { Hand } from '../../src/hand';
import { Orbit } from '../../src/orbit';
import type { Wish } from '../../src/protocol';
import { tower } from './towers';

/** A tower of which every block leans by `angle` about the y-axis. */
function leaning(angle: number): Bodies {
  const upright = tower(['xxx', 'xxx', 'xxx']);
  const lean = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle);
  const poses = Array.from({ length: upright.count }, (_, body) => [
    ...upright.position(body).applyQuaternion(lean).toArray(),
    ...lean.clone().multiply(upright.turn(body)).toArray(),
  ]);
  return new Bodies(upright.sizes, Float32Array.from(poses.flat()));
}

/** The wishes of a hand that grasps the middle block of the lowest row by its end and follows a pointer. */
function drag(bodies: Bodies, ways: [number, number][]): Wish[] {
  const wishes: Wish[] = [];
  const client = { hand: (wish: Wish | null) => wish && wishes.push(wish) } as unknown as Client;
  const orbit = new Orbit(true);
  orbit.resize(900, 700);
  orbit.frame(bodies.top(), 0.3);
  const hand = new Hand(client, orbit, bodies);
  hand.resize(900, 700);
  const end = bodies.surface(1, new Vector3(bodies.size(1).x / 2, 0, 0));
  const eye = orbit.camera.position;
  hand.press(pick(bodies, eye, end.clone().sub(eye).normalize())!);
  for (const [dx, dy] of ways) hand.drag(dx, dy);
  return wishes;
}

test.each([0, 0.02, -0.02, 0.1])('a block of a tower that leans by %f is drawn along its own length', angle => {
  const bodies = leaning(angle);
  const wishes = drag(bodies, Array(10).fill([4, 18]));
  expect(wishes.length).toBe(11);
  expect(wishes[0]).toMatchObject({ body: 1, grip: 'slide' });
  const way = new Vector3(...wishes[10].target).sub(new Vector3(...wishes[0].target));
  expect(way.length()).toBeGreaterThan(0.02);
  // Sideways is level; along the block the way leaves its bed by nothing.
  const bed = new Vector3(0, 0, 1).applyQuaternion(bodies.turn(1));
  expect(Math.abs(way.dot(bed)), 'way out of the bed of the block, m').toBeLessThan(1e-6);
  expect(wishes[10].orientation, 'kept as it lies').toEqual(bodies.turn(1).toArray());
});

test('what leans too far for a row is drawn level, and what stands on its end somewhere', () => {
  const turned = (angle: number) => drawn(new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle));
  expect(turned(-0.2).z).toBeCloseTo(Math.sin(0.2), 9);
  for (const angle of [0.5, 1, Math.PI / 2, 2]) {
    expect(turned(angle).z).toBe(0);
    expect(turned(angle).length()).toBeCloseTo(1, 9);
  }
});
