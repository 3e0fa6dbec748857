// Messages between the page and its worker. SI units.

import type { Contact, Form, GameCommand, StepReport, TimedReport, Update } from './game-protocol';

export type BlockPreset = 'dissertation' | 'official';

/** Names of the tables of rules. */
export type TableName = 'free' | 'official' | 'strict' | 'friendly' | 'dissertation' | 'solo' | 'throw-and-go';

/** Choice of rules: a table, and what differs from it. */
export interface RulesChoice {
  table: TableName;
  players: number;
  /** Player who begins, from 0. */
  first?: number;
  /** Seed of the die. */
  die?: number;
}

/** Rules of a world. */
export interface Rules extends Required<Omit<RulesChoice, 'die'>> {
  /** Time of a turn, s; null without a clock. */
  turn_s: number | null;
  /** Longest time of settling, s. */
  settle_s: number;
  /** Largest force that the hand may be given, N. */
  max_force: number;
  points: { block: number; row: number } | null;
}

/** Source of the scene that a world is built from. */
export type SceneSource =
  | { kind: 'tower'; rows: number; seed: number; block: BlockPreset }
  | { kind: 'named'; name: string }
  /** A scene as JSON. */
  | { kind: 'scene'; text: string }
  /** A recorded game, which goes on where it ended. */
  | { kind: 'record'; bytes: Uint8Array }
  /** A recorded game that is played again; `engines` is the address of the kept engines. */
  | { kind: 'replay'; bytes: Uint8Array; engines: string };

/** Computer player of a game. */
export interface ComputerPlayer {
  /** From 0. */
  player: number;
  strength: string;
  /** Seed of its errors. */
  seed: number;
}

/**
 * Engine of a record: that of this page, a kept one of another version, or missing. Without it the
 * keyframes are shown.
 */
export type RecordEngine = 'own' | 'kept' | 'missing';

/** State of a replay. */
export interface ReplayState {
  frame: number;
  frames: number;
  engine: RecordEngine;
  /** False from the frame on that the engine computes otherwise; null where it is missing. */
  same: boolean | null;
}

/** Scene of a world and the choices that go with it. */
export interface Setup {
  source: SceneSource;
  /** True if resting blocks may sleep. */
  sleep: boolean;
  /** Stiffness of the contacts, N/m; null for the stiffest that the device runs in real time. */
  stiffness: number | null;
  /** Null for springs inside the blocks where the device runs them in real time. */
  form: Form | null;
  /** Stiffness of the springs inside the blocks, N/m; null for that of the contacts. */
  springs: number | null;
  /** Null for free play. */
  rules: RulesChoice | null;
  computers: ComputerPlayer[];
}

/** A constant of a tower. */
export interface Constant<T> {
  value: T;
  /** True if the device decided the value. */
  chosen: boolean;
}

export interface SceneEntry {
  name: string;
  title: string;
}

/** Update of a game and the arrays that go with it. */
export interface Frame<R extends TimedReport = StepReport> {
  type: 'frame';
  /** Number of the world that the frame belongs to. */
  world: number;
  update: Update<R>;
  /** Number of the last command that has been applied. */
  applied: number;
  /** Seven numbers per body: position (m), orientation (x, y, z, w). */
  poses: Float32Array;
  /**
   * Particles and springs as in view/lattice.ts; null where there are none or nothing of them is
   * visible.
   */
  lattices: Float32Array | null;
  /** Sounds as in sound/sounds.ts; null where nobody listens. */
  sounds: Float32Array | null;
  /** True if the selected block could be placed on top. */
  placeable: boolean;
  /** Simulated time per wall time over the last second. */
  factor: number;
  /** Simulated time per time spent stepping over the last second. */
  capacity: number;
  /** Null in a game. */
  replay: ReplayState | null;
}

export interface Built {
  type: 'built';
  world: number;
  /** Edge lengths, three numbers per body, m. */
  sizes: Float32Array;
  poses: Float32Array;
  /** Stiffness of the contacts, N/m. */
  stiffness: Constant<number>;
  form: Constant<Form>;
  /** Stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  springs: number | null;
  /**
   * Distance of the particles from the block's centre along each axis, as a fraction of half the
   * edge.
   */
  particleOffset: number;
  /** Null where the simulator knows no rules. */
  rules: Rules | null;
  /** True for a game that goes on from its record. */
  resumed: boolean;
  /** Number of frames of a replay; null for a game. */
  frames: number | null;
}

/** Contact forces of a tower at rest; sent when rest begins and when it ends. */
export interface XRay {
  type: 'xray';
  world: number;
  /** Two numbers per body as in xray/readings.ts; null while the tower moves. */
  forces: Float32Array | null;
}

/** Record of a game so far, and its simulated time, s. */
export interface RecordState {
  bytes: Uint8Array;
  time: number;
}

/** The last move: the tower as it stood at its turn's start, and all commands since. */
export interface LastMove {
  /** JSON. */
  scene: string;
  rules: Rules;
  commands: GameCommand[];
  /** True if a block fell, and if the block was placed. */
  fell: boolean;
  placed: boolean;
}

/** Question of a computer player (JSON), and the world that it is about. */
export interface Deliberation {
  type: 'deliberation';
  world: number;
  player: number;
  question: string;
  state: Uint8Array;
}

/** Hash of a state, and its simulated time, s. */
export interface StateHash {
  hash: string;
  time: number;
}

/**
 * Questions about the present state, and about the states of all steps until a simulated time, s.
 */
export type Question =
  | { what: 'hash' }
  | { what: 'hashes'; until: number }
  | { what: 'contacts'; body: number }
  /** Record of the game so far; with its state it is resumed at once. */
  | { what: 'record'; state: boolean }
  /** The world of this moment, for analyses. */
  | { what: 'world' }
  /** The last turn in which a block was moved. */
  | { what: 'move' }
  | { what: 'xray' };
export type Answer<Q extends Question> = Q extends { what: 'hash' }
  ? StateHash
  : Q extends { what: 'hashes' }
    ? StateHash[]
    : Q extends { what: 'record' }
      ? RecordState | null
      : Q extends { what: 'world' }
        ? Uint8Array
        : Q extends { what: 'move' }
          ? LastMove | null
          : Q extends { what: 'xray' }
            ? Float32Array
            : Contact[];

/** Parts of the page that need more from a frame than its poses. */
export interface Watched {
  springs: boolean;
  xray: boolean;
  sound: boolean;
  /** Selected block, of which the page asks whether it could be placed. */
  selected: number | null;
}

export type ToWorker<S = Setup> =
  | { type: 'build'; world: number; setup: S }
  | { type: 'command'; world: number; number: number; command: GameCommand }
  | { type: 'pause'; paused: boolean }
  /** Simulated time per wall time. */
  | { type: 'speed'; speed: number }
  | { type: 'watch'; watched: Watched }
  /** Goes to a frame of a replay. */
  | { type: 'seek'; world: number; frame: number }
  /** Moves that a computer player considered, the chosen one first (JSON). */
  | { type: 'decided'; world: number; player: number; considered: string }
  | { type: 'ask'; id: number; question: Question };

export type FromWorker =
  | { type: 'scenes'; list: SceneEntry[] }
  | Built
  | Frame
  | XRay
  | { type: 'answer'; id: number; value: unknown }
  | Deliberation
  /** The scene could not be built; the previous world goes on. */
  | { type: 'refused'; world: number; message: string }
  /** A message that was not carried out: all is as it was. `id`: that of a question. */
  | { type: 'invalid'; id: number | null; message: string }
  /** The worker cannot go on. */
  | { type: 'failed'; message: string };
