// Messages between the museum and its workers, besides those of the game. SI units.

import type { TimedReport, Vec } from '../engine/game-protocol';
import type { Frame, Question, ToWorker } from '../engine/protocol';

/**
 * Tower that is drawn in wood: that of the 2003 method, or the engine's, without or with the
 * other's ghost.
 */
export type Show = 'old' | 'engine' | 'both';

/** Constants of the 2003 method by name, as in its ini file. */
export type ConstantValues = Record<string, string>;

/** Towers to build. */
export interface MuseumSetup {
  show: Show;
  /** Name of a listed scene; null for a tower of rows. */
  scene: string | null;
  rows: number;
  seed: number;
  /** Constants that are not at their defaults. */
  constants: ConstantValues;
}

/** Values that a constant accepts. */
export type ConstantRange =
  | { kind: 'number' | 'number-or-none' | 'whole'; min: number; max: number }
  | { kind: 'switch' }
  | { kind: 'choice'; names: string[] };

/** A constant of the 2003 method. */
export interface ConstantEntry {
  section: string;
  name: string;
  unit: string;
  range: ConstantRange;
  meaning: string;
  /** Reason of the default. */
  reason: string;
  default: number | boolean | string | null;
}

/** A pointer on the screen, as a ray from the camera. */
export interface Pointer2003 {
  /** Position of the camera, m. */
  origin: Vec;
  direction: Vec;
  /** The camera's z axis. */
  toward_viewer: Vec;
}

/** Request to the hand of 2003. */
export type Request2003 =
  | { request: 'pick' | 'drag' | 'resume'; pointer: Pointer2003 }
  /** `distance`: m. */
  | { request: 'pull'; distance: number; toward_viewer: Vec }
  | { request: 'release' };

/** Question to the museum's worker. */
export type MuseumQuestion = Question | { what: 'constants' } | { what: 'set'; values: ConstantValues };

export type ToMuseum =
  | Extract<ToWorker<MuseumSetup>, { type: 'build' | 'command' | 'pause' | 'watch' }>
  | { type: 'ask'; id: number; question: MuseumQuestion }
  | { type: 'request'; world: number; request: Request2003 };

/** Work of a frame of the 2003 method. */
export interface Report2003 extends TimedReport {
  /** Largest number of rounds over the pairs in a step. */
  rounds: number;
  /** Calls of the collision routine that ended with collisions left. */
  unresolved: number;
  /** Tests of the last step: pairs without culling, exact tests, and collisions. */
  tests: { potential: number; after_planes: number; collisions: number };
  /** Number of blocks that are not disabled. */
  active: number;
  /** Velocity of the fastest block at the end of the frame, m/s. */
  max_speed: number;
  /** Disabled blocks. */
  disabled: number[];
  /**
   * Block of the hand, target of its centre (m) and force on it (N); the force is null where the
   * hand writes the velocity.
   */
  hand: { body: number; target: Vec; force: Vec | null } | null;
}

/** A frame, with the poses of the tower in wood. */
export interface MuseumFrame extends Frame<TimedReport> {
  /** State of the ghost; null without one. */
  ghost: { poses: Float32Array; lattices: Float32Array } | null;
  old: Report2003 | null;
  /** Mean cost of a frame, s; null for a tower that does not run. */
  costs: { old: number | null; engine: number | null };
}

export type Method = 'springs' | 'constraint' | 'penalty' | 'micro-collisions';
export type Setting = 'stack' | 'falling' | 'tower';

/** Scene in the plane to build. */
export interface PlaneSetup {
  method: Method;
  setting: Setting;
  count: number;
  /** Gap between falling blocks, m. */
  gap: number;
  /** N/m; null for the default. */
  stiffness: number | null;
}

/** Work of the steps since the last picture. */
export interface PlaneCounts {
  /** Simulated time, s. */
  time: number;
  /** Pairs resolved, impulses, or rounds of the last step. */
  iterations: number;
  /** Largest number of iterations of a step. */
  most: number;
  /** Steps cut short since the beginning. */
  cut: number;
  /** Steps without a solution for the forces at rest, since the beginning. */
  unsolved: number;
  /** Contact points. */
  points: number;
  /** Tests of the last step. */
  tests: number;
  /** Deepest overlap of two blocks, m. */
  overlap: number;
}

export interface PlaneFrame {
  type: 'frame';
  /** Number of the scene that the frame belongs to. */
  scene: number;
  /** Eight numbers per block: corners, counter-clockwise, m. */
  corners: Float32Array;
  /** Five numbers per point: position (m), unit normal, force (N). */
  contacts: Float32Array;
  /** Held point and pointer, m; empty if no block is held. */
  held: Float32Array;
  counts: PlaneCounts;
  /** Simulated time per wall time. */
  factor: number;
}

export type ToPlane =
  | { type: 'build'; scene: number; setup: PlaneSetup }
  /** `speed`: simulated time per wall time; 0 pauses. */
  | { type: 'speed'; speed: number }
  /** Advances the method by one step. */
  | { type: 'single' }
  | { type: 'hold'; x: number; y: number }
  | { type: 'drag'; x: number; y: number }
  | { type: 'release' }
  | { type: 'add'; x: number; y: number; vx: number; vy: number };

export type FromPlane =
  | PlaneFrame
  /** A request that cannot be met. */
  | { type: 'refused'; message: string }
  /** A message that cannot be read, a fault of the page; all is as it was. */
  | { type: 'invalid'; message: string }
  /** The worker cannot go on. */
  | { type: 'failed'; message: string };
