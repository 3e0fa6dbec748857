// Gestures become commands: a drag becomes a displacement along the axes of the hand, a tap a poke,
// and a carried block is attracted by a slot once it has left its own.

import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { initialPlay, type PlayState } from '../../src/app/state';
import { Store } from '../../src/app/store';
import { readOptions } from '../../src/app/url';
import type { GameCommand, HandUpdate, Slot, Vec } from '../../src/engine/game-protocol';
import { Hand } from '../../src/hand/hand';
import { Bodies } from '../../src/view/bodies';
import { Orbit } from '../../src/view/orbit';
import { pick } from '../../src/view/picking';
import { PITCH, SIZE, tower } from './towers';

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

/** A game whose blocks do not move: only its hand follows the commands. */
class StillGame {
  hand: HandUpdate | null = null;
  slots: Slot[] = [];

  constructor(
    private readonly bodies: Bodies,
    private readonly grip: 'slide' | 'carry',
  ) {}

  apply(command: GameCommand): void {
    const { hand } = this;
    if (command.command === 'grasp') this.hand = this.grasped(command.body, command.anchor);
    else if (!hand) return;
    else if (command.command === 'release' || command.command === 'poke') this.hand = null;
    else if (command.command === 'place') this.hand = { ...hand, placing: true };
    else if (command.command === 'move') {
      const goal = hand.goal.map((x, k) => x + command.displacement[k]) as Vec;
      this.hand = { ...hand, goal, slot: command.slot };
    }
  }

  private grasped(body: number, anchor: Vec): HandUpdate {
    const { bodies, grip } = this;
    const point = bodies.toWorld(body, new Vector3(...anchor)).toArray() as Vec;
    const along = new Vector3(1, 0, 0).applyQuaternion(bodies.rotation(body));
    const across = new Vector3(0, 0, 1).cross(along).normalize();
    const axes = grip === 'slide' ? [along, across].map(axis => axis.toArray() as Vec) : [];
    const position = { body, anchor, axes, point, target: point, goal: point, orientation: null, slot: null };
    const state = { placing: false, poking: false, capped: false, stuck_s: 0, contacts: [] };
    return { ...position, ...state, grip, mode: 'auto', force: [0, 0, 0] };
  }
}

/** A page with a still game that takes one command a frame. */
function play(bodies: Bodies, grip: 'slide' | 'carry' = 'slide') {
  const store = new Store<PlayState>(initialPlay(readOptions('')));
  const orbit = new Orbit(true);
  orbit.resize(900, 700);
  orbit.frame(bodies.top(), 0.3);
  const game = new StillGame(bodies, grip);
  const commands: GameCommand[] = [];
  let applied = 0;
  const hand = new Hand({ command: command => commands.push(command) }, store, orbit, () => bodies);
  function frame() {
    if (applied < commands.length) game.apply(commands[applied++]);
    const update = { report: {}, hand: game.hand, slots: game.slots, tower: 'standing' } as never;
    const next = { type: 'frame', world: 1, update, applied, placeable: false } as never;
    store.set({ frame: next });
    hand.receive(next);
  }
  return { hand, orbit, frame, commands, game };
}

/** Presses a block on its end. */
function pressEnd({ hand, orbit }: ReturnType<typeof play>, bodies: Bodies, body = 1): void {
  const end = bodies.surface(body, new Vector3(bodies.size(body).x / 2, 0, 0));
  const eye = orbit.camera.position;
  hand.press(pick(bodies, eye, end.clone().sub(eye).normalize())!);
}

/** Sum of the displacements of all moves, m. */
function displacementOf(commands: GameCommand[]): Vector3 {
  const sum = new Vector3();
  for (const command of commands) if (command.command === 'move') sum.add(new Vector3(...command.displacement));
  return sum;
}

test.each([0, 0.02, -0.02, 0.1])('a block of a tower that leans by %f is pulled along its own length', angle => {
  const bodies = leaning(angle);
  const page = play(bodies);
  pressEnd(page, bodies);
  page.frame();
  expect(page.hand.held).toMatchObject({ body: 1, grip: 'slide' });
  for (let i = 0; i < 10; i++) {
    page.hand.drag({ x: 4, y: 18 });
    page.frame();
  }
  expect(page.commands.length).toBe(11);
  const displacement = displacementOf(page.commands);
  expect(displacement.length()).toBeGreaterThan(0.02);
  // Sideways is level; along the block the displacement stays in its bed.
  const bed = new Vector3(0, 0, 1).applyQuaternion(bodies.rotation(1));
  expect(Math.abs(displacement.dot(bed)), 'displacement out of the bed of the block, m').toBeLessThan(1e-6);
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

test('a slot attracts a carried block once the block has left it, and takes the block that is released there', () => {
  const bodies = tower(['xxx', 'xxx', '.x.']);
  const page = play(bodies, 'carry');
  const position = (cell: number): Vec => [0, (cell - 1) * PITCH, 2.5 * SIZE.z];
  const slot = (cell: number): Slot => ({
    row: 2,
    cell,
    position: position(cell),
    orientation: [0, 0, 0, 1],
    clearance: 0.024,
  });
  page.game.slots = [slot(1)];
  pressEnd(page, bodies, 6);
  page.frame();
  const { orbit, hand } = page;
  const attracted = () => {
    for (let i = 0; i < 3; i++) page.frame();
    return hand.held?.slot ?? null;
  };
  const scale = orbit.scaleAt(new Vector3(...position(1)));
  hand.drag({ x: 0.006 * scale, y: 0 });
  page.frame();
  expect(hand.gesture).toBe('carrying');
  expect(attracted(), 'not before it has left').toBeNull();
  hand.drag({ x: 0.06 * scale, y: 0 });
  expect(attracted(), 'out of reach').toBeNull();
  hand.drag({ x: -0.06 * scale, y: 0 });
  expect(attracted()).toEqual({ row: 2, cell: 1 });
  hand.release(false);
  page.frame();
  expect(hand.gesture).toBe('placing');
  expect(page.commands.at(-1)).toEqual({ command: 'place', body: null, slot: { row: 2, cell: 1 } });
});
