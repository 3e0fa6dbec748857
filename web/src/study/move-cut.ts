// A record of one move: the tower as it stood at the start of the turn, in rounded numbers, and the
// commands of the turn. It is a game of its own, so what was played comes out nearly, not exactly.

import { FRAME, type GameCommand, type Update } from '../engine/game-protocol';
import type { LastMove } from '../engine/protocol';
import { Game } from '../wasm/teeter_wasm.js';
import type { OneMove } from './jobs';
import { thinned } from './thinning';

/** Parts of a metre of heights and of other lengths, of a kilogram and of a unit quaternion. */
const HEIGHT = 1e6;
const LENGTH = 1e5;
const MASS = 1e5;
const ROTATION = 1e5;
/** Frames that the tower rests before the move, and longest time after it, s. */
const BEFORE = 12;
const AFTER = 12;
/** Frames after the end of the turn. */
const TAIL = 12;
/** Frames whose displacements are summed, the coarsest first. */
const STRIDES = [6, 3, 1];

interface Block {
  size: number[];
  mass?: number;
  pos: number[];
  orientation?: number[];
  velocity?: number[];
  spin?: number[];
}

/** A game that is played with the commands of a move. */
class Attempt {
  fell = false;
  placed = false;
  private done = 0;
  private tail = 0;

  constructor(
    private readonly game: Game,
    private readonly commands: readonly GameCommand[],
  ) {
    game.startRecord();
  }

  get bytes(): Uint8Array {
    return this.game.record()!;
  }

  /** Plays a frame; returns the part that is done. */
  step(): number {
    const command = this.commands[this.done] ?? { command: 'idle' };
    const { events } = JSON.parse(this.game.step(JSON.stringify(command))) as Update;
    this.done += 1;
    this.fell ||= events.some(({ event }) => event === 'fell');
    this.placed ||= events.some(({ event }) => event === 'placed');
    const isNext = events.some(({ event }) => event === 'turn_started') && this.done > 1;
    if (this.fell || isNext || this.tail > 0) this.tail += 1;
    const frames = this.commands.length + AFTER / FRAME;
    return this.tail > TAIL || this.done >= frames ? 1 : Math.min(0.99, this.done / frames);
  }

  free(): void {
    this.game.free();
  }
}

export class MoveCut {
  private readonly scene: string;
  private readonly commands: GameCommand[];
  private attempt: Attempt;
  private tried = 0;

  constructor(private readonly move: LastMove) {
    this.scene = rounded(move.scene);
    this.commands = trimmed(move.commands);
    this.attempt = this.begin();
  }

  /** Plays a frame; returns the part that is done. The coarsest commands of the same end count. */
  step(): number {
    const part = this.attempt.step();
    if (part < 1 || this.isSame || this.tried === STRIDES.length - 1) return part;
    this.attempt.free();
    this.tried += 1;
    this.attempt = this.begin();
    return 0;
  }

  result(): OneMove {
    return { bytes: this.attempt.bytes, same: this.isSame };
  }

  free(): void {
    this.attempt.free();
  }

  private get isSame(): boolean {
    const { fell, placed } = this.attempt;
    return fell === this.move.fell && (fell || placed === this.move.placed);
  }

  private begin(): Attempt {
    const idle: GameCommand = { command: 'idle' };
    const commands = thinned(this.commands, STRIDES[this.tried]);
    const game = new Game(this.scene, JSON.stringify({ frame: FRAME }), JSON.stringify(alone(this.move.rules)));
    return new Attempt(game, [...Array.from({ length: BEFORE }, () => idle), ...commands]);
  }
}

/** The rules for the one player who makes the move. */
function alone(rules: LastMove['rules']): object {
  return { ...rules, players: 1, first: 0 };
}

/** Commands without those at the end that do nothing. */
function trimmed(commands: GameCommand[]): GameCommand[] {
  let end = commands.length;
  while (end > 0 && commands[end - 1].command === 'idle') end -= 1;
  return commands.slice(0, end);
}

function rounded(text: string): string {
  const scene = JSON.parse(text) as { blocks: Block[] };
  const to = (parts: number) => (x: number) => Math.round(x * parts) / parts + 0;
  for (const block of scene.blocks) {
    const [x, y, z] = block.pos;
    // Upward, or a block on the table would be in it.
    block.pos = [...[x, y].map(to(LENGTH)), Math.ceil(z * HEIGHT) / HEIGHT];
    block.size = block.size.map(to(HEIGHT));
    if (block.mass !== undefined) block.mass = to(MASS)(block.mass);
    if (block.orientation) block.orientation = block.orientation.map(to(ROTATION));
    // The tower rests before the move.
    delete block.velocity;
    delete block.spin;
  }
  return JSON.stringify(scene);
}
