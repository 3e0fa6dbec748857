// A game in wasm memory: commands in, updates and arrays out. It has no clock and no messages.

import { LATTICE_STRIDE, maxDeformation, strains } from '../view/lattice';
import { Game as WasmGame, Listener, Opponent as WasmOpponent } from '../wasm/teeter_wasm.js';
import { rounded } from './command-rounding';
import { FRAME, POSE_STRIDE, type Contact, type Form } from './game-protocol';
import type { GameCommand, Update } from './game-protocol';
import type { Played } from './played';
import type { ComputerPlayer, LastMove, RecordState, Rules, RulesChoice } from './protocol';
import { particleOffset } from './scene';

/** Displacement of a block's corner by deformation from which it is visible, m. */
const VISIBLE = 5e-5;
/** Longest turn that can be shared, frames. */
const MAX_MOVE = 7200;

export class Game implements Played {
  readonly replay = null;
  readonly length: number;
  readonly particleOffset: number;
  readonly rules: Rules;
  /** The last turn in which a block was touched; `open` until the next one begins. */
  private move: (Omit<LastMove, 'rules'> & { open: boolean }) | null = null;
  private computers: { player: number; opponent: WasmOpponent; asked: string | null }[] = [];
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
    this.seat([]);
    this.game.free();
  }

  get stiffness(): number {
    return this.game.stiffness;
  }

  get form(): Form {
    return this.game.form as Form;
  }

  get springStiffness(): number | null {
    return this.game.springStiffness ?? null;
  }

  sizes(): Float32Array {
    return this.edges.slice();
  }

  poses(): Float32Array {
    return Float32Array.from(this.poseView());
  }

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

  xray(): Float32Array {
    return Float32Array.from(this.game.xray());
  }

  /** None of the first frame that is listened to. */
  sounds(): Float32Array {
    if (this.listener) return this.listener.hear(this.game);
    this.listener = new Listener(this.game);
    return new Float32Array();
  }

  hash(): string {
    return this.game.hash();
  }

  time(): number {
    return this.game.time();
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.game.contacts(body)) as Contact[];
  }

  record(state: boolean): RecordState | null {
    const bytes = this.game.record(state);
    return bytes ? { bytes, time: this.time() } : null;
  }

  world(): Uint8Array {
    return this.game.world();
  }

  lastMove(): LastMove | null {
    if (!this.move) return null;
    const { scene, commands, fell, placed } = this.move;
    return { scene, commands, fell, placed, rules: this.rules };
  }

  /** Sets the computer players. */
  seat(computers: ComputerPlayer[]): void {
    for (const { opponent } of this.computers) opponent.free();
    this.computers = computers.map(({ player, strength, seed }) => ({
      player,
      opponent: new WasmOpponent(player, strength, seed),
      asked: null,
    }));
  }

  /** Returns a question of a computer player that was not asked before. */
  question(): { player: number; question: string } | null {
    for (const computer of this.computers) {
      const question = computer.opponent.question(this.game) ?? null;
      const isNew = question !== null && question !== computer.asked;
      computer.asked = question;
      if (isNew) return { player: computer.player, question: question };
    }
    return null;
  }

  /** Hands the moves that it considered to a computer player. */
  decide(player: number, considered: string): void {
    const computer = this.computers.find(other => other.player === player);
    if (computer?.asked) computer.opponent.answer(considered);
  }

  /** Command of the computer player whose turn it is; null where there is none, or it thinks. */
  computerCommand(): GameCommand | null {
    for (const { opponent } of this.computers) {
      // It would answer a question itself, also one that was not asked yet: of a resumed game.
      if (opponent.question(this.game) !== undefined) continue;
      const command = JSON.parse(opponent.next(this.game)) as GameCommand;
      if (command.command !== 'idle') return command;
    }
    return null;
  }

  canPlace(body: number): boolean {
    return body < this.length && this.game.canPlace(body);
  }

  step(command: GameCommand): Update {
    const given = rounded(command);
    // Before the first grasp of a turn all that passes is time.
    if (given.command === 'grasp' && !this.move?.open) {
      this.move = { scene: this.game.scene(), commands: [], fell: false, placed: false, open: true };
    }
    const update = JSON.parse(this.game.step(JSON.stringify(given))) as Update;
    this.logMove(given, update);
    return update;
  }

  private logMove(command: GameCommand, { events, turn }: Update): void {
    const { move } = this;
    if (!move?.open) return;
    move.commands.push(command);
    move.fell ||= events.some(({ event }) => event === 'fell');
    move.placed ||= events.some(({ event }) => event === 'placed');
    const end = turn ? 'turn_started' : 'placed';
    if (events.some(({ event }) => event === end) || turn?.phase === 'over') move.open = false;
    // Nobody shares a turn of minutes.
    if (move.commands.length > MAX_MOVE) this.move = null;
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
