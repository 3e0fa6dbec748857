// The hand slides a block along its own length, which leans with the tower, and gestures become commands.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { initialPlay, type PlayState } from '../../src/app/state';
import { Store } from '../../src/app/store';
import { readOptions } from '../../src/app/url';
import { FRAME, type GameCommand, type StepReport } from '../../src/engine/game-protocol';
import { HandControl } from '../../src/hand/control/hand-control';
import type { HandTarget } from '../../src/hand/control/simulator';
import { Hand } from '../../src/hand/hand';
import { pullDirection } from '../../src/hand/pull-direction';
import { Bodies } from '../../src/view/bodies';
import { Orbit } from '../../src/view/orbit';
import { pick } from '../../src/view/picking';
import { still, tower } from './towers';

/** A tower of which every block leans by `angle` about the y-axis. */
function leaning(angle: number): Bodies {
  const upright = tower(['xxx', 'xxx', 'xxx']);
  const lean = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle);
  const poses = Array.from({ length: upright.count }, (_, body) => [
    ...upright.position(body).applyQuaternion(lean).toArray(),
    ...lean.clone().multiply(upright.rotation(body)).toArray(),
  ]);
  return new Bodies(upright.sizes, Float32Array.from(poses.flat()));
}

/** A page whose game takes one command a frame and whose blocks do not move. */
function play(bodies: Bodies) {
  const store = new Store<PlayState>(initialPlay(readOptions('')));
  const orbit = new Orbit(true);
  orbit.resize(900, 700);
  orbit.frame(bodies.top(), 0.3);
  const control = new HandControl(still(bodies), bodies);
  const commands: GameCommand[] = [];
  let applied = 0;
  const hand = new Hand({ command: command => commands.push(command) }, store, orbit, () => bodies);
  const targets: HandTarget[] = [];
  const report = { time: 0, hand: null } as unknown as StepReport;
  function frame() {
    for (; applied < commands.length; applied++) control.apply(commands[applied], []);
    const goal = control.hold && control.goal(control.hold);
    const target = control.advance(FRAME);
    if (goal && target) targets.push({ ...target, target: goal.target, orientation: goal.orientation });
    report.time += FRAME;
    control.observe(report, []);
    const update = { report, hand: control.update(), slots: [], tower: 'standing' } as never;
    const next = { type: 'frame', world: 1, update, applied, placeable: false } as never;
    store.set({ frame: next });
    hand.receive(next);
  }
  return { hand, orbit, frame, targets, commands };
}

/** Presses the middle block of the lowest row on its end. */
function pressEnd({ hand, orbit }: ReturnType<typeof play>, bodies: Bodies): void {
  const end = bodies.surface(1, new Vector3(bodies.size(1).x / 2, 0, 0));
  const eye = orbit.camera.position;
  hand.press(pick(bodies, eye, end.clone().sub(eye).normalize())!);
}

test.each([0, 0.02, -0.02, 0.1])('a block of a tower that leans by %f is pulled along its own length', angle => {
  const bodies = leaning(angle);
  const page = play(bodies);
  pressEnd(page, bodies);
  page.frame();
  for (let i = 0; i < 10; i++) {
    page.hand.drag({ x: 4, y: 18 });
    page.frame();
  }
  const { targets } = page;
  expect(targets.length).toBe(11);
  expect(targets[0]).toMatchObject({ body: 1, grip: 'slide' });
  const displacement = new Vector3(...targets[10].target).sub(new Vector3(...targets[0].target));
  expect(displacement.length()).toBeGreaterThan(0.02);
  // Sideways is level; along the block the displacement stays in its bed.
  const bed = new Vector3(0, 0, 1).applyQuaternion(bodies.rotation(1));
  expect(Math.abs(displacement.dot(bed)), 'displacement out of the bed of the block, m').toBeLessThan(1e-6);
  expect(targets[10].orientation, 'kept as it lies').toEqual(bodies.rotation(1).toArray());
});

test('a drag before the grasp has been applied counts once it has been', () => {
  const bodies = tower(['xxx', 'xxx', 'xxx']);
  const page = play(bodies);
  pressEnd(page, bodies);
  page.hand.drag({ x: 4, y: 60 });
  expect(page.commands.map(c => c.command)).toEqual(['grasp']);
  page.frame();
  expect(page.commands.map(c => c.command)).toEqual(['grasp', 'move']);
  expect(page.hand.gesture).toBe('sliding');
});

test('a tap pokes, Escape releases, and an old update does not bring the block back', () => {
  const bodies = tower(['xxx', 'xxx', 'xxx']);
  const page = play(bodies);
  pressEnd(page, bodies);
  page.frame();
  page.hand.release(true);
  expect(page.hand.gesture).toBe('poking');
  for (let i = 0; i < 30; i++) page.frame();
  expect(page.hand.gesture).toBe('idle');
  pressEnd(page, bodies);
  page.frame();
  expect(page.hand.held).not.toBeNull();
  page.hand.letGo();
  expect(page.hand.held).toBeNull();
  expect(page.hand.gesture).toBe('idle');
  expect(page.commands.map(c => c.command)).toEqual(['grasp', 'poke', 'grasp', 'release']);
});

test('a block that leans too far for a row is pulled level, and so is one that stands on its end', () => {
  const rotated = (angle: number) => pullDirection(new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle));
  expect(rotated(-0.2).z).toBeCloseTo(Math.sin(0.2), 9);
  for (const angle of [0.5, 1, Math.PI / 2, 2]) {
    expect(rotated(angle).z).toBe(0);
    expect(rotated(angle).length()).toBeCloseTo(1, 9);
  }
});
