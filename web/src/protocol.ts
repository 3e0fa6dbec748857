// What page and worker say to each other. SI units; vectors are [x, y, z], orientations [x, y, z, w].

export type Vec = [number, number, number];
export type Quat = [number, number, number, number];

/** Numbers a body in a pose array: position, orientation. */
export const POSE_STRIDE = 7;
/** Time that one step covers, s. */
export const FRAME = 1 / 60;

export type BlockPreset = 'dissertation' | 'official';

/** What to build a world from. */
export type SceneSource =
  { kind: 'tower'; rows: number; seed: number; block: BlockPreset } | { kind: 'named'; name: string };

/** What blocks are: rigid, or particles held together by springs. */
export type Form = 'rigid' | 'lattice';

/** What to build, and how. */
export interface Setup {
  source: SceneSource;
  /** Whether resting blocks may sleep. */
  sleep: boolean;
  /** Stiffness of the contacts, N/m; null for the stiffest that the device holds in real time. */
  stiffness: number | null;
  /** What the blocks are; null for springs inside where the device holds real time with them. */
  form: Form | null;
  /** Stiffness of the springs within the blocks, N/m; null for that of the contacts. */
  springs: number | null;
}

/** A constant of a tower. */
export interface Constant<T> {
  value: T;
  /** Whether it was chosen for the device. */
  chosen: boolean;
}

export interface SceneEntry {
  name: string;
  title: string;
}

export type Grip = 'slide' | 'carry' | 'push';

/** Where the player wants the hand. The worker leads the hand there within the limits named here. */
export interface Wish {
  body: number;
  /** Grasped point in the body's frame, m. */
  anchor: Vec;
  /** Where that point is wanted, m. */
  target: Vec;
  /** Orientation wanted; null leaves it free. */
  orientation: Quat | null;
  grip: Grip;
  /** Direction of a push, unit vector. */
  axis: Vec;
  /** Largest force, N. */
  maxForce: number;
  /** Largest torque, N m. */
  maxTorque: number;
  /** Largest speed of the target, m/s. */
  speed: number;
  /** How far the target may be ahead of the grasped point, m. */
  lead: number;
  /** Simulated time after which the hand lets go by itself, s; null never. */
  seconds: number | null;
}

/** A loaded contact of a body; `other` is null for the table. */
export interface Contact {
  other: number | null;
  point: Vec;
  /** Direction in which the other presses on the body. */
  normal: Vec;
  /** N. */
  force: number;
}

export interface HandState {
  body: number;
  grip: Grip;
  /** Force of the hand on the block, N. */
  force: Vec;
  capped: boolean;
  /** The grasped point, m. */
  point: Vec;
  /** Where the hand pulls it, m. */
  target: Vec;
  contacts: Contact[];
}

export interface Frame {
  type: 'frame';
  /** Number of the world that this frame belongs to. */
  world: number;
  /** Simulated time, s. */
  time: number;
  poses: Float32Array;
  hand: HandState | null;
  /** Whether a hand with a time limit let go in this frame. */
  handDone: boolean;
  awake: number;
  touching: number;
  /** Deepest overlap, m. */
  penetration: number;
  /** Fastest body, m/s. */
  maxSpeed: number;
  /** Bodies frozen so far because their state ran away. */
  quarantined: number[];
  /** Simulated time per wall time over the last second. */
  factor: number;
  /** Simulated time per time spent stepping over the last second: what this device could do. */
  capacity: number;
  form: Form;
  /** Stiffness of the springs within the blocks at the moment, N/m; null where they are rigid. */
  springs: number | null;
  /** Particles and springs, as lattice.ts has them; null where the blocks have none, or nobody looks and nothing of them is seen. */
  lattices: Float32Array | null;
}

export interface Built {
  type: 'built';
  world: number;
  /** Edge lengths, three numbers a body, m. */
  sizes: Float32Array;
  poses: Float32Array;
  /** Stiffness of the contacts, N/m. */
  stiffness: Constant<number>;
  form: Constant<Form>;
  /** Stiffness of the springs within the blocks, N/m; null where they are rigid. */
  springs: number | null;
  /** Distance of the particles inside blocks from the centre along each axis, over half the edge. */
  place: number;
}

/** What the contacts of a tower at rest say of its blocks, told once when rest has begun and once when it has ended. */
export interface XRay {
  type: 'xray';
  world: number;
  /** Two numbers a body, as xray.ts has them; null while the tower moves. */
  forces: Float32Array | null;
}

export type Question = { what: 'hash' } | { what: 'contacts'; body: number };
export type Answer<Q extends Question> = Q extends { what: 'hash' } ? { hash: string; time: number } : Contact[];

export type ToWorker<S = Setup> =
  | { type: 'build'; world: number; setup: S }
  | { type: 'hand'; world: number; wish: Wish | null }
  | { type: 'pause'; paused: boolean }
  /** What the blocks of the running tower are to become; `springs` as in [`Setup`]. */
  | { type: 'form'; world: number; form: Form; springs: number | null }
  /** Whether the springs are looked at, and whether the X-ray is. */
  | { type: 'watch'; springs: boolean; xray: boolean }
  | { type: 'ask'; id: number; question: Question };

export type FromWorker =
  | { type: 'scenes'; list: SceneEntry[] }
  | Built
  | Frame
  | XRay
  | { type: 'answer'; id: number; value: unknown }
  /** The scene could not be built; the world before it stays. */
  | { type: 'refused'; world: number; message: string }
  /** The worker cannot go on. */
  | { type: 'failed'; message: string };
