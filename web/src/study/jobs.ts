// Work that takes seconds, done by workers beside the game: thoughts of computer players, analyses,
// and checks of records.

import type { TurnState } from '../engine/game-protocol';
import type { LastMove, RecordEngine, Rules, Setup } from '../engine/protocol';

/** A job. `seconds`: longest time, s, after which the result so far counts. */
export type Job = { seconds: number } & (
  | { kind: 'think'; state: Uint8Array; question: string }
  | { kind: 'tower'; state: Uint8Array; rules: string; budget: number }
  | { kind: 'record'; bytes: Uint8Array; budget: number }
  /** `engines` is the address of the kept engines, `setup` that of a game with this beginning. */
  | { kind: 'verify'; bytes: Uint8Array; engines: string; setup: Setup }
  | { kind: 'cut'; move: LastMove }
);

export interface Chance {
  chance_of_fall: number;
  /** Ends of the interval of 95 %. */
  low: number;
  high: number;
  rollouts: number;
}

/** A move that a computer player considered. */
export interface Considered extends Chance {
  body: number;
  toward: [number, number, number];
  cost: number;
}

/** A block of a tower. */
export interface BlockChance extends Chance {
  body: number;
  chance_stuck: number;
}

/** A move of a record; players count from 0. */
export interface MoveChance extends Chance {
  turn: number;
  player: number;
  body: number;
  at_s: number;
  safest: ({ body: number } & Chance) | null;
  blunder: boolean;
  fell: boolean;
}

/** Loaded contact that was lost first; `below` is null for the table. */
export interface LostContact {
  above: number;
  below: number | null;
  load_N: number;
  at_s: number;
}

/** Analysis of a record. */
export interface RecordReport {
  moves: MoveChance[];
  /** Index of the riskiest move. */
  riskiest: number | null;
  fall: { at_s: number; bodies: number[]; taken: number; first_lost: LostContact | null } | null;
}

/** A record that was played again by the engine that wrote it. */
export interface Verified {
  /** True if every frame is that of the record; null where its engine is missing. */
  same: boolean | null;
  /** Identity of the engine that wrote the record. */
  engine: string;
  origin: RecordEngine;
  /** True if it begins as the games of the setup. */
  begins: boolean;
  rules: Rules;
  /** Scene at the start, as JSON. */
  scene: string;
  /** State of the last turn; null in free play. */
  turn: TurnState | null;
  /** Duration of the first pull, s; null where no block was placed. */
  pull: number | null;
  /** Height of the tower when it stood last, m, and the poses of its blocks. */
  height: number;
  poses: Float32Array;
  /** First frame that differs, and its time, s; null where none does. */
  divergence: { frame: number; time_s: number } | null;
}

/** A record of one move, on the tower as it stood before. */
export interface OneMove {
  bytes: Uint8Array;
  /** True if it ends as what was played. */
  same: boolean;
}

export type Result<J extends Job> = J extends { kind: 'think' }
  ? Considered[]
  : J extends { kind: 'tower' }
    ? BlockChance[]
    : J extends { kind: 'record' }
      ? RecordReport
      : J extends { kind: 'cut' }
        ? OneMove
        : Verified;

export type ToStudy = { type: 'run'; id: number; job: Job } | { type: 'stop'; id: number };

export type FromStudy =
  /** Part of the work that is done, 0 to 1. */
  | { type: 'progress'; id: number; part: number }
  | { type: 'result'; id: number; value: unknown }
  /** `id`: null where the message was no job. */
  | { type: 'failed'; id: number | null; message: string };
