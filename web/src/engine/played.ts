// What the worker steps and shows: a game, or a recorded one that is played again.

import type { Contact, Form, GameCommand, Update } from './game-protocol';
import type { LastMove, RecordState, ReplayState, Rules } from './protocol';

export interface Played {
  /** Number of bodies. */
  readonly length: number;
  /** Distance of the particles from the block's centre along each axis, over half the edge. */
  readonly particleOffset: number;
  readonly rules: Rules;
  /** Stiffness of the contacts, N/m. */
  readonly stiffness: number;
  readonly form: Form;
  /** Current stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  readonly springStiffness: number | null;
  /** Null in a game. */
  readonly replay: ReplayState | null;
  /** Edge lengths, three numbers per body, m; a copy that may be transferred. */
  sizes(): Float32Array;
  /** Poses, seven numbers per body; a copy that may be transferred. */
  poses(): Float32Array;
  /**
   * Particles and springs, a copy that may be transferred. Null where they are neither `watched`
   * nor visibly deform a block.
   */
  lattices(watched: boolean): Float32Array | null;
  /** Load and breakaway force of each body, two numbers per body as in xray/readings.ts. */
  xray(): Float32Array;
  /** The world of this moment as bytes, for analyses. */
  world(): Uint8Array;
  /** Sounds of the last frame as in sound/sounds.ts; null where it cannot be heard. */
  sounds(): Float32Array | null;
  hash(): string;
  /** Simulated time, s. */
  time(): number;
  contacts(body: number): Contact[];
  /** Returns true if the command to place the body would be carried out. */
  canPlace(body: number): boolean;
  /** Record so far; with its state it is resumed at once. Null for one that is played again. */
  record(state: boolean): RecordState | null;
  /** The last turn in which a block was moved; null before one. */
  lastMove(): LastMove | null;
  /** Steps by a frame; null after the last. A replay has commands of its own. */
  step(command: GameCommand): Update | null;
  free(): void;
}

/** A recorded game that is played again. */
export interface Replayed extends Played {
  readonly replay: ReplayState;
  /** Goes toward a frame; returns true once it is there. */
  seek(frame: number): boolean;
  /** Update of the last frame that was played; null at the start. */
  update(): Update | null;
}

export function isReplayed(game: Played): game is Replayed {
  return game.replay !== null;
}
