// A game in wasm memory: commands in, updates and arrays out. It has no clock and no messages.

import { LATTICE_STRIDE, maxDeformation, strains } from '../view/lattice';
import { Game as WasmGame, Listener } from '../wasm/teeter_wasm.js';
import { rounded } from './command-rounding';
import { FRAME, POSE_STRIDE, type Contact, type Form } from './game-protocol';
import type { GameCommand, Update } from './game-protocol';
import type { RecordState, Rules, RulesChoice } from './protocol';
import { particleOffset } from './scene';

/** Displacement of a block's corner by deformation from which it is visible, m. */
const VISIBLE = 5e-5;

export class Game {
  /** Number of bodies. */
  readonly length: number;
  /** Distance of the particles from the block's centre along each axis, over half the edge. */
  readonly particleOffset: number;
  readonly rules: Rules;
  private readonly edges: Float32Array;
  private listener: Listener | null = null;

  /** `scene` describes the blocks, whatever has become of them since. */
  private constructor(
    private readonly game: WasmGame,
    scene: string,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.length = this.game.length;
    this.edges = Float32Array.from(this.game.sizes());
    this.particleOffset = particleOffset(scene);
    this.rules = JSON.parse(this.game.ownRules()) as Rules;
  }

  /** Begins a game, which is recorded. Throws an Error whose message is for the user. */
  static begin(scene: string, sleep: boolean, rules: RulesChoice | null, memory: WebAssembly.Memory): Game {
    const game = new WasmGame(scene, JSON.stringify({ sleep, frame: FRAME }), rules ? rulesText(rules) : '');
    game.startRecord();
    return new Game(game, scene, memory);
  }

  /** Goes on with a recorded game. Throws an Error whose message is for the user. */
  static resume(record: Uint8Array, memory: WebAssembly.Memory): Game {
    const game = WasmGame.resume(record);
    return new Game(game, game.scene(), memory);
  }

  free(): void {
    this.listener?.free();
    this.game.free();
  }

  /** Stiffness of the contacts, N/m. */
  get stiffness(): number {
    return this.game.stiffness;
  }

  get form(): Form {
    return this.game.form as Form;
  }

  /** Current stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  get springStiffness(): number | null {
    return this.game.springStiffness ?? null;
  }

  /** Edge lengths, three numbers per body, m; a copy that may be transferred. */
  sizes(): Float32Array {
    return this.edges.slice();
  }

  /** Poses, seven numbers per body; a copy that may be transferred. */
  poses(): Float32Array {
    return Float32Array.from(this.poseView());
  }

  /**
   * Particles and springs, a copy that may be transferred. Null where they are neither `watched`
   * nor visibly deform a block.
   */
  lattices(watched: boolean): Float32Array | null {
    if (this.form === 'rigid') return null;
    // The pointer comes first: writing the particles may let memory grow.
    const pointer = this.game.latticesPtr();
    const lattices = new Float32Array(this.memory.buffer, pointer, this.length * LATTICE_STRIDE);
    if (!watched) {
      const strain = strains(lattices, this.poseView(), this.edges, this.particleOffset);
      if (maxDeformation(strain, this.edges) < VISIBLE) return null;
    }
    return lattices.slice();
  }

  /** Load and breakaway force of each body, two numbers per body as in xray/readings.ts. */
  xray(): Float32Array {
    return Float32Array.from(this.game.xray());
  }

  /** Sounds of the last frame as in sound/sounds.ts; none of the first one that is listened to. */
  sounds(): Float32Array {
    if (this.listener) return this.listener.hear(this.game);
    this.listener = new Listener(this.game);
    return new Float32Array();
  }

  hash(): string {
    return this.game.hash();
  }

  /** Simulated time, s. */
  time(): number {
    return this.game.time();
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.game.contacts(body)) as Contact[];
  }

  /** Record of the game so far as bytes; with its state it is resumed at once. */
  record(state: boolean): RecordState | null {
    const bytes = this.game.record(state);
    return bytes ? { bytes, time: this.time() } : null;
  }

  /** Returns true if the command to place the body would be carried out. */
  canPlace(body: number): boolean {
    return body < this.length && this.game.canPlace(body);
  }

  /** Carries out a command and steps by a frame. */
  step(command: GameCommand): Update {
    return JSON.parse(this.game.step(JSON.stringify(rounded(command)))) as Update;
  }

  /** Memory may have grown since the last view, so each one is new. */
  private poseView(): Float64Array {
    return new Float64Array(this.memory.buffer, this.game.posesPtr(), this.length * POSE_STRIDE);
  }
}

/** Rules as the engine takes them. */
function rulesText({ table, players, ...changes }: RulesChoice): string {
  return JSON.stringify({ ...(JSON.parse(WasmGame.rules(table, players)) as Rules), ...changes });
}
