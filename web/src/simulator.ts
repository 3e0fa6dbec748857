// The wasm world with the hand led along: what the worker runs. It knows no clock and no messages.

import { Glide } from './glide';
import { grasped, sameGrasp } from './grasp';
import { farthest, LATTICE_STRIDE, strains } from './lattice';
import { Leash } from './leash';
import {
  FRAME,
  POSE_STRIDE,
  type Contact,
  type Form,
  type HandState,
  type SceneSource,
  type Vec,
  type Wish,
} from './protocol';
import { length } from './vectors';
import { Simulation, namedScene, towerScene } from './wasm/teeter_wasm.js';

/** What is touched here of a scene. */
interface Scene {
  blocks: unknown[];
  stiffness: number;
  form?: Form;
  springs?: { stiffness?: number; damping?: number; particles?: 'inside' | 'corners' };
}

/** What a scene itself says of its blocks. */
export interface Own {
  blocks: number;
  form: Form | null;
  /** Stiffness of the springs within them, N/m; null for that of the contacts. */
  springs: number | null;
}

/** What is chosen for a scene. Stiffness is that of the contacts, N/m. */
export interface Choice {
  form: Form;
  stiffness: number;
  springs: number | null;
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

/** How far strain moves a corner of a block before it is drawn, m. */
const SEEN = 5e-5;

/** The scene as JSON, with what `choose` chooses. Throws an Error whose message is for the user. */
export function sceneText(source: SceneSource, choose: (own: Own) => Choice): string {
  const text =
    source.kind === 'named'
      ? namedScene(source.name)
      : towerScene(JSON.stringify({ rows: source.rows, seed: source.seed, block: source.block }));
  const scene = JSON.parse(text) as Scene;
  // Springs inside are said in a scene, rigid blocks are what it has where nothing is said.
  const own = {
    blocks: scene.blocks.length,
    form: scene.form === 'lattice' ? scene.form : null,
    springs: scene.springs?.stiffness ?? null,
  };
  const { form, stiffness, springs } = choose(own);
  scene.stiffness = stiffness;
  scene.form = form;
  scene.springs = { ...scene.springs, stiffness: springs ?? undefined };
  return JSON.stringify(scene);
}

export class Simulator {
  private readonly simulation: Simulation;
  private readonly glide: Glide;
  /** Edge lengths, three numbers a body, m. */
  private readonly edges: Float32Array;
  /** What the scene says of springs besides their stiffness. */
  private readonly springs: Scene['springs'];
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
    this.edges = Float32Array.from(this.simulation.sizes());
    this.springs = (JSON.parse(scene) as Scene).springs;
    this.glide = new Glide({ form: this.form, springs: this.springStiffness ?? this.stiffness }, this.stiffness);
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

  /** What the blocks are at the moment. */
  get form(): Form {
    return this.simulation.form as Form;
  }

  /** Stiffness of the springs within the blocks at the moment, N/m; null where they are rigid. */
  get springStiffness(): number | null {
    return this.simulation.springStiffness ?? null;
  }

  /** Distance of the particles inside blocks from the centre along each axis, over half the edge. */
  get place(): number {
    return this.springs?.particles === 'corners' ? 1 : 1 / Math.sqrt(3);
  }

  /** What the blocks are to become within the next steps; springs null for the stiffness of the contacts. */
  become(form: Form, springs: number | null): void {
    this.glide.want({ form, springs: springs ?? this.stiffness });
  }

  /** Edge lengths, a copy that may be given away. */
  sizes(): Float32Array {
    return this.edges.slice();
  }

  /** A copy of the poses that may be given away. */
  poses(): Float32Array {
    return Float32Array.from(this.view());
  }

  /** A copy of the particles and springs that may be given away: where they are `watched` or have visibly strained a block. */
  lattices(watched: boolean): Float32Array | null {
    if (this.form === 'rigid') return null;
    // The place is asked for first: writing them down may let memory grow.
    const at = this.simulation.latticesPtr();
    const view = new Float32Array(this.memory.buffer, at, this.simulation.length * LATTICE_STRIDE);
    if (!watched && farthest(strains(view, this.view(), this.edges, this.place), this.edges) < SEEN) return null;
    return view.slice();
  }

  /** What each body carries and how tight it is, two numbers a body as xray.ts has them. */
  xray(): Float32Array {
    return Float32Array.from(this.simulation.xray());
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
    if (!sameGrasp(wish, this.wish)) {
      this.leash = null;
      this.held = 0;
      this.force = 0;
    }
    this.wish = wish;
  }

  step(): Step {
    const blocks = this.glide.next();
    if (blocks)
      this.simulation.setForm(
        JSON.stringify({ form: blocks.form, springs: { ...this.springs, stiffness: blocks.springs } }),
      );
    const wish = this.wish;
    if (!wish) return this.finish('', null);
    const { point, orientation } = grasped(this.view(), wish);
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

  /** What a frame tells of the last step; the poses are a copy that may be given away. */
  told({ report, hand, handDone }: Step) {
    return {
      time: report.time,
      poses: this.poses(),
      hand,
      handDone,
      awake: report.awake,
      touching: report.touching,
      penetration: report.penetration,
      maxSpeed: report.max_speed,
      quarantined: report.quarantined,
      form: this.form,
    };
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
      point: report.hand?.point ?? grasped(this.view(), wish).point,
      target: this.leash?.target() ?? wish.target,
      contacts: this.contacts(wish.body),
    };
    const handDone = wish !== null && wish.seconds !== null && this.held >= wish.seconds;
    if (handDone) this.want(null);
    return { report, hand, handDone };
  }

  /** Memory may have grown since the last view, so each is made anew. */
  private view(): Float64Array {
    return new Float64Array(this.memory.buffer, this.simulation.posesPtr(), this.simulation.length * POSE_STRIDE);
  }
}
