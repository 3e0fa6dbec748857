// The wasm world with the hand led along: what the worker runs. It knows no clock and no messages.

import { Leash } from './leash';
import { FRAME, POSE_STRIDE, type Contact, type HandState, type Quat, type SceneSource, type Vec, type Wish } from './protocol';
import { add, length, rotate } from './vectors';
import { Simulation, namedScene, towerScene } from './wasm/teeter_wasm.js';

/** What is touched here of a scene. */
interface Scene {
  blocks: unknown[];
  stiffness: number;
}

interface StepReport {
  time: number;
  awake: number;
  touching: number;
  penetration: number;
  max_speed: number;
  quarantined: number[];
  hand: { force: Vec; torque: Vec; capped: boolean; point: Vec } | null;
}

export interface Step {
  report: StepReport;
  hand: HandState | null;
  handDone: boolean;
}

/** Part of the largest force from which the hand counts as giving all it has. */
const SPENT = 0.98;

/** The scene as JSON, with the stiffness that `choose` gives for its number of blocks, N/m. Throws an Error whose message is for the user. */
export function sceneText(source: SceneSource, choose: (blocks: number) => number): string {
  const text =
    source.kind === 'named'
      ? namedScene(source.name)
      : towerScene(JSON.stringify({ rows: source.rows, seed: source.seed, block: source.block }));
  const scene = JSON.parse(text) as Scene;
  scene.stiffness = choose(scene.blocks.length);
  return JSON.stringify(scene);
}

export class Simulator {
  private readonly simulation: Simulation;
  private readonly quarantined = new Set<number>();
  private wish: Wish | null = null;
  private leash: Leash | null = null;
  private held = 0;
  /** Force of the hand in the last step, N. */
  private force = 0;

  /** Throws an Error whose message is for the user. */
  constructor(
    scene: string,
    sleep: boolean,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.simulation = new Simulation(scene, JSON.stringify({ sleep, frame: FRAME }));
  }

  free(): void {
    this.simulation.free();
  }

  /** Number of bodies. */
  get length(): number {
    return this.simulation.length;
  }

  /** Stiffness of the contacts, N/m. */
  get stiffness(): number {
    return this.simulation.stiffness;
  }

  sizes(): Float32Array {
    return Float32Array.from(this.simulation.sizes());
  }

  /** A copy of the poses that may be given away. */
  poses(): Float32Array {
    return Float32Array.from(this.view());
  }

  hash(): string {
    return this.simulation.hash();
  }

  time(): number {
    return this.simulation.time();
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.simulation.contacts(body)) as Contact[];
  }

  /** What the player wants of the hand; null lets go. */
  want(wish: Wish | null): void {
    if (wish && wish.body >= this.simulation.length) return;
    const same = wish && this.wish && wish.body === this.wish.body && wish.anchor.every((x, i) => x === this.wish!.anchor[i]);
    if (!same) {
      this.leash = null;
      this.held = 0;
      this.force = 0;
    }
    this.wish = wish;
  }

  step(): Step {
    const wish = this.wish;
    if (!wish) return this.finish('', null);
    const { point, orientation } = this.grasped(wish);
    this.leash ??= new Leash(point, orientation);
    this.leash.advance(wish, point, this.force > SPENT * wish.maxForce, FRAME);
    this.held += FRAME;
    const hand = {
      body: wish.body,
      anchor: wish.anchor,
      target: this.leash.target(),
      orientation: wish.orientation ? this.leash.orientation() : null,
      grip: wish.grip,
      axis: wish.axis,
      max_force: wish.maxForce,
      max_torque: wish.maxTorque,
    };
    return this.finish(JSON.stringify({ hand }), wish);
  }

  private finish(input: string, wish: Wish | null): Step {
    const report = JSON.parse(this.simulation.step(input)) as StepReport;
    for (const body of report.quarantined) this.quarantined.add(body);
    report.quarantined = [...this.quarantined];
    this.force = report.hand ? length(report.hand.force) : 0;
    const hand: HandState | null = wish && {
      body: wish.body,
      grip: wish.grip,
      force: report.hand?.force ?? [0, 0, 0],
      capped: report.hand?.capped ?? false,
      point: report.hand?.point ?? this.grasped(wish).point,
      target: this.leash?.target() ?? wish.target,
      contacts: this.contacts(wish.body),
    };
    const handDone = wish !== null && wish.seconds !== null && this.held >= wish.seconds;
    if (handDone) this.want(null);
    return { report, hand, handDone };
  }

  private grasped(wish: Wish): { point: Vec; orientation: Quat } {
    const at = wish.body * POSE_STRIDE;
    const [x, y, z, ...turn] = this.view().subarray(at, at + POSE_STRIDE);
    const orientation = turn as Quat;
    return { point: add([x, y, z], rotate(orientation, wish.anchor)), orientation };
  }

  /** Memory may have grown since the last view, so each is made anew. */
  private view(): Float64Array {
    return new Float64Array(this.memory.buffer, this.simulation.posesPtr(), this.simulation.length * POSE_STRIDE);
  }
}
