// The game of the page: the engine's world with a hand, stepped by commands. It has no clock and no messages.

import { ControlledGame } from '../hand/control/controlled-game';
import type { Blocks, HandTarget, Simulator } from '../hand/control/simulator';
import { LATTICE_STRIDE, maxDeformation, strains } from '../view/lattice';
import { Simulation } from '../wasm/teeter_wasm.js';
import { FRAME, POSE_STRIDE, type Contact, type Form } from './game-protocol';
import type { GameCommand, StepReport, Update } from './game-protocol';
import type { Scene } from './scene';

/** Displacement of a block's corner by deformation from which it is visible, m. */
const VISIBLE = 5e-5;

class World implements Simulator {
  readonly length: number;
  readonly sizes: Float32Array;
  readonly handStiffness = null;
  /** Fields of the scene about springs, of which only the stiffness changes. */
  private readonly springs: Scene['springs'];

  /** Throws an Error whose message is for the user. */
  constructor(
    readonly simulation: Simulation,
    scene: string,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.length = simulation.length;
    this.sizes = Float32Array.from(simulation.sizes());
    this.springs = (JSON.parse(scene) as Scene).springs;
  }

  get stiffness(): number {
    return this.simulation.stiffness;
  }

  get form(): Form {
    return this.simulation.form as Form;
  }

  get springStiffness(): number | null {
    return this.simulation.springStiffness ?? null;
  }

  get particleOffset(): number {
    return this.springs?.particles === 'corners' ? 1 : 1 / Math.sqrt(3);
  }

  // Memory may have grown since the last view, so each one is new.
  poses(): Float64Array {
    return new Float64Array(this.memory.buffer, this.simulation.posesPtr(), this.length * POSE_STRIDE);
  }

  lattices(): Float32Array | null {
    if (this.form === 'rigid') return null;
    // The pointer comes first: writing the particles may let memory grow.
    const pointer = this.simulation.latticesPtr();
    return new Float32Array(this.memory.buffer, pointer, this.length * LATTICE_STRIDE);
  }

  deformed(): Float32Array | null {
    const lattices = this.lattices();
    if (!lattices) return null;
    const strain = strains(lattices, this.poses(), this.sizes, this.particleOffset);
    return maxDeformation(strain, this.sizes) < VISIBLE ? null : lattices;
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.simulation.contacts(body)) as Contact[];
  }

  contactForces(): Float32Array {
    return Float32Array.from(this.simulation.xray());
  }

  setBlocks({ form, springs }: Blocks): void {
    this.simulation.setForm(JSON.stringify({ form, springs: { ...this.springs, stiffness: springs } }));
  }

  step(hand: HandTarget | null): StepReport {
    return JSON.parse(this.simulation.step(hand ? JSON.stringify({ hand }) : '')) as StepReport;
  }
}

export class Game {
  private readonly world: World;
  private readonly control: ControlledGame;

  /** Throws an Error whose message is for the user. */
  constructor(scene: string, sleep: boolean, memory: WebAssembly.Memory) {
    const simulation = new Simulation(scene, JSON.stringify({ sleep, frame: FRAME }));
    this.world = new World(simulation, scene, memory);
    this.control = new ControlledGame(this.world);
  }

  free(): void {
    this.world.simulation.free();
  }

  /** Number of bodies. */
  get length(): number {
    return this.world.length;
  }

  /** Stiffness of the contacts, N/m. */
  get stiffness(): number {
    return this.world.stiffness;
  }

  get form(): Form {
    return this.world.form;
  }

  /** Current stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  get springStiffness(): number | null {
    return this.world.springStiffness;
  }

  /** Distance of the particles from the block's centre along each axis, as a fraction of half the edge. */
  get particleOffset(): number {
    return this.world.particleOffset;
  }

  /** Edge lengths, three numbers per body, m; a copy that may be transferred. */
  sizes(): Float32Array {
    return this.world.sizes.slice();
  }

  /** Poses, seven numbers per body; a copy that may be transferred. */
  poses(): Float32Array {
    return Float32Array.from(this.world.poses());
  }

  /** Particles and springs, a copy that may be transferred; null where they are neither `watched` nor visibly deform a block. */
  lattices(watched: boolean): Float32Array | null {
    const lattices = watched ? this.world.lattices() : this.world.deformed();
    return lattices?.slice() ?? null;
  }

  /** Load and starting force of each body, two numbers per body as in xray/readings.ts. */
  xray(): Float32Array {
    return this.world.contactForces();
  }

  hash(): string {
    return this.world.simulation.hash();
  }

  /** Simulated time, s. */
  time(): number {
    return this.world.simulation.time();
  }

  contacts(body: number): Contact[] {
    return this.world.contacts(body);
  }

  /** Returns true if the block is free and there is a slot to place it in. */
  canPlace(body: number): boolean {
    return body < this.length && this.control.canPlace(body);
  }

  /** Applies a command and steps by a frame. */
  step(command: GameCommand): Update {
    return this.control.step(command);
  }
}
