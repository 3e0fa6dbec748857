// What the museum's page and its workers say to each other, besides what the game has. SI units.

import type { Frame } from '../protocol';

/** Whose tower is shown: that of the 2003 method, that of the engine, or the engine's with the other's ghost. */
export type Show = 'old' | 'engine' | 'both';

/** What to build. */
export interface Order {
  show: Show;
  rows: number;
  seed: number;
  /** Whether the 2003 method has what its text leaves for future work. */
  future: boolean;
}

/** What a frame of the 2003 method was like. */
export interface OldReport {
  /** Most rounds over the pairs in one of its steps. */
  rounds: number;
  /** Steps that ended with collisions left. */
  unresolved: number;
  /** Potential collisions of its last step: without culling, and left for the exact test. */
  potential: number;
  exact: number;
  collisions: number;
  /** Blocks that are not disabled. */
  active: number;
}

/** A frame; the poses are those of the tower in wood. */
export interface MuseumFrame extends Frame {
  /** Of the ghost, where there is one. */
  ghost: { poses: Float32Array; lattices: Float32Array } | null;
  old: OldReport | null;
  /** Mean time of the processor for one frame, s; null for what does not run. */
  costs: { old: number | null; engine: number | null };
}

export type Method = 'springs' | 'constraint' | 'penalty' | 'micro-collisions';
export type Setting = 'stack' | 'falling' | 'tower';

/** What to build in the plane. */
export interface PlaneOrder {
  method: Method;
  setting: Setting;
  count: number;
  /** How far apart blocks are that fall, m. */
  gap: number;
  /** N/m; null for the usual one. */
  stiffness: number | null;
}

/** What the steps since the last picture did. */
export interface PlaneCounts {
  /** Simulated time, s. */
  time: number;
  /** Pairs resolved, impulses, or rounds, of the last step. */
  iterations: number;
  /** The same of the step that took most. */
  most: number;
  /** Steps cut short since the beginning. */
  cut: number;
  /** Steps without an answer for the forces at rest, since the beginning. */
  unsolved: number;
  /** Contact points. */
  points: number;
  /** Tests of the last step. */
  tests: number;
  /** How deep blocks are inside each other, m. */
  overlap: number;
}

export interface PlaneFrame {
  type: 'frame';
  /** Number of the scene that it belongs to. */
  scene: number;
  /** Eight numbers a block: corners, counter-clockwise, m. */
  corners: Float32Array;
  /** Five numbers a point: place (m), unit normal, force (N). */
  contacts: Float32Array;
  /** The held point and the pointer, m; empty where nothing is held. */
  held: Float32Array;
  counts: PlaneCounts;
  /** Simulated time per wall time. */
  factor: number;
}

export type ToPlane =
  | { type: 'build'; scene: number; order: PlaneOrder }
  /** `speed`: simulated time per wall time that is wanted; 0 stands still. */
  | { type: 'speed'; speed: number }
  /** One step of the method. */
  | { type: 'single' }
  | { type: 'hold'; x: number; y: number }
  | { type: 'drag'; x: number; y: number }
  | { type: 'release' }
  | { type: 'add'; x: number; y: number; vx: number; vy: number };

export type FromPlane =
  | PlaneFrame
  /** What was asked for cannot be done. */
  | { type: 'refused'; message: string }
  /** The worker cannot go on. */
  | { type: 'failed'; message: string };
