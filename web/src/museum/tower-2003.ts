// The 2003 tower as a game. It has no clock and no messages.

import type { Contact, GameCommand, StepReport, Update, Vec } from '../engine/game-protocol';
import { POSE_STRIDE } from '../engine/game-protocol';
import { ControlledGame } from './control/controlled-game';
import { graspedPoint } from './control/grasped-point';
import type { HandTarget, Simulator } from './control/simulator';
import { sub } from './control/vectors';
import { LATTICE_STRIDE } from '../view/lattice';
import { Space } from '../wasm/teeter_museum.js';
import type { Report2003 } from './protocol';

interface SpaceReport {
  time: number;
  active: number;
  touching: number;
  max_speed: number;
  rounds: number;
  unresolved: number;
  tests: { potential: number; after_planes: number; collisions: number };
  hand: { force: Vec | null } | null;
}

/**
 * The hand of 2003 has a target for the block's centre, no orientation and no force limit: a spring
 * to the target while the block touches anything, and the block's velocity itself in the air. Its
 * force is limited here by the lead of the target.
 */
class Simulator2003 implements Simulator {
  readonly length: number;
  readonly sizes: Float32Array;
  // The particles of 2003 are the corners.
  readonly particleOffset = 1;
  readonly handStiffness: number;
  report: Report2003 | null = null;

  constructor(
    readonly space: Space,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.length = space.length;
    this.sizes = space.sizes();
    this.handStiffness = space.handStiffness;
  }

  // Memory may have grown since the last view, so each one is new.
  poses(): Float64Array {
    return new Float64Array(this.memory.buffer, this.space.posesPtr(), this.length * POSE_STRIDE);
  }

  deformed(): Float32Array {
    // The pointer comes first: writing the particles may let memory grow.
    const pointer = this.space.latticesPtr();
    return new Float32Array(this.memory.buffer, pointer, this.length * LATTICE_STRIDE);
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.space.contacts(body)) as Contact[];
  }

  step(hand: HandTarget | null): StepReport {
    const report = JSON.parse(this.space.step(hand ? this.centreTarget(hand) : '')) as SpaceReport;
    const { potential, after_planes: exact, collisions } = report.tests;
    const { rounds, unresolved, active } = report;
    this.report = { rounds, unresolved, potential, exact, collisions, active };
    return {
      time: report.time,
      awake: active,
      touching: report.touching,
      penetration: 0,
      max_speed: report.max_speed,
      quarantined: [],
      hand: hand && {
        force: report.hand?.force ?? [0, 0, 0],
        torque: [0, 0, 0],
        capped: false,
        point: graspedPoint(this.poses(), hand.body, hand.anchor).point,
      },
    };
  }

  private centreTarget({ body, anchor, target }: HandTarget): string {
    const { centre, point } = graspedPoint(this.poses(), body, anchor);
    return JSON.stringify({ body, target: sub(target, sub(point, centre)) });
  }
}

export class Game2003 {
  private readonly simulator: Simulator2003;
  private readonly control: ControlledGame;

  /** Throws an Error whose message is for the user. */
  constructor(scene: string, extended: boolean, memory: WebAssembly.Memory) {
    this.simulator = new Simulator2003(new Space(scene, extended), memory);
    this.control = new ControlledGame(this.simulator);
  }

  free(): void {
    this.simulator.space.free();
  }

  /** Work of the last step. */
  get report(): Report2003 | null {
    return this.simulator.report;
  }

  sizes(): Float32Array {
    return this.simulator.sizes.slice();
  }

  /** A copy that may be transferred. */
  poses(): Float32Array {
    return Float32Array.from(this.simulator.poses());
  }

  /** A copy that may be transferred. */
  lattices(): Float32Array {
    return this.simulator.deformed().slice();
  }

  contacts(body: number): Contact[] {
    return this.simulator.contacts(body);
  }

  canPlace(body: number): boolean {
    return this.control.canPlace(body);
  }

  step(command: GameCommand): Update {
    return this.control.step(command);
  }
}
