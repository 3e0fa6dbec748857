// The 2003 tower with the hand led along, as simulator.ts is for the engine. It knows no clock and no messages.

import { grasped, sameGrasp } from '../grasp';
import { LATTICE_STRIDE } from '../lattice';
import { Leash } from '../leash';
import { FRAME, POSE_STRIDE, type Contact, type HandState, type Vec, type Wish } from '../protocol';
import { sub } from '../vectors';
import { Space } from '../wasm/teeter_museum.js';
import type { OldReport } from './protocol';

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

export interface OldStep {
  time: number;
  touching: number;
  maxSpeed: number;
  report: OldReport;
  hand: HandState | null;
  handDone: boolean;
}

export class Old {
  private readonly space: Space;
  private wish: Wish | null = null;
  private leash: Leash | null = null;
  private held = 0;

  /** Throws an Error whose message is for the user. */
  constructor(
    scene: string,
    future: boolean,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.space = new Space(scene, future);
  }

  free(): void {
    this.space.free();
  }

  sizes(): Float32Array {
    return this.space.sizes();
  }

  poses(): Float32Array {
    return Float32Array.from(this.view());
  }

  /** A copy of the particles and springs that may be given away. */
  lattices(): Float32Array {
    // The place is asked for first: writing them down may let memory grow.
    const at = this.space.latticesPtr();
    return new Float32Array(this.memory.buffer, at, this.space.length * LATTICE_STRIDE).slice();
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.space.contacts(body)) as Contact[];
  }

  /** What the player wants of the hand; null lets go. */
  want(wish: Wish | null): void {
    if (wish && wish.body >= this.space.length) return;
    if (!sameGrasp(wish, this.wish)) {
      this.leash = null;
      this.held = 0;
    }
    this.wish = wish;
  }

  /**
   * One frame. The hand of 2003 has a place for the block's centre, no turn and no bound on its force: a spring to that place while the block
   * touches anything, and the block's velocity itself in the air. Its force is bounded here by how far that place may be ahead.
   */
  step(): OldStep {
    const wish = this.wish;
    let told = '';
    if (wish) {
      const { centre, point, orientation } = grasped(this.view(), wish);
      this.leash ??= new Leash(point, orientation);
      const lead = wish.grip === 'carry' ? wish.lead : wish.maxForce / this.space.handStiffness;
      this.leash.advance({ ...wish, lead }, point, false, FRAME);
      this.held += FRAME;
      told = JSON.stringify({ body: wish.body, target: sub(this.leash.target(), sub(point, centre)) });
    }
    const report = JSON.parse(this.space.step(told)) as SpaceReport;
    const hand: HandState | null = wish && {
      body: wish.body,
      grip: wish.grip,
      force: report.hand?.force ?? [0, 0, 0],
      capped: false,
      point: grasped(this.view(), wish).point,
      target: this.leash!.target(),
      contacts: this.contacts(wish.body),
    };
    const handDone = wish !== null && wish.seconds !== null && this.held >= wish.seconds;
    if (handDone) this.want(null);
    const { potential, after_planes: exact, collisions } = report.tests;
    const { rounds, unresolved, active } = report;
    return {
      time: report.time,
      touching: report.touching,
      maxSpeed: report.max_speed,
      report: { rounds, unresolved, potential, exact, collisions, active },
      hand,
      handDone,
    };
  }

  /** Memory may have grown since the last view, so each is made anew. */
  private view(): Float64Array {
    return new Float64Array(this.memory.buffer, this.space.posesPtr(), this.space.length * POSE_STRIDE);
  }
}
