// Commands that a game takes and updates that it returns: one of each a frame, as JSON. SI units;
// vectors are [x, y, z] in the world unless said otherwise, orientations [x, y, z, w].

export type Vec = [number, number, number];
export type Quat = [number, number, number, number];

/** Numbers per body in a pose array: position, orientation. */
export const POSE_STRIDE = 7;
/** Simulated time of one step, s. */
export const FRAME = 1 / 60;

/** Model of the blocks: rigid, or particles joined by springs. */
export type Form = 'rigid' | 'lattice';

export type Grip = 'slide' | 'carry' | 'push';
/** Grip that a grasp asks for; `auto` slides a block in the tower and carries a free one. */
export type GripMode = 'auto' | Grip;

/** Names a free slot of the top row. */
export interface SlotId {
  row: number;
  cell: number;
}

export interface Slot extends SlotId {
  /** Centre of a block that lies there, m. */
  position: Vec;
  orientation: Quat;
  /** Height above the slot at which a block passes over its neighbours, m. */
  clearance: number;
}

export type GameCommand =
  | { command: 'idle' }
  /**
   * `anchor`: touched point in the body's frame, m. `normal`: outward normal of the touched face.
   */
  | { command: 'grasp'; body: number; anchor: Vec; normal: Vec; grip: GripMode }
  /**
   * Moves the target of the hand, m. `slot` attracts a carried block; `toward_viewer` is
   * horizontal.
   */
  | { command: 'move'; displacement: Vec; slot: SlotId | null; toward_viewer: [number, number] | null }
  /** Rotates the target orientation of a carried block about its centre. */
  | { command: 'turn'; rotation: Quat }
  /**
   * Sets down the held block, or a free one that is named. Null takes the slot that attracts it,
   * else the nearest.
   */
  | { command: 'place'; body: number | null; slot: SlotId | null }
  /** Pushes the held block in by a few millimetres, or releases one that cannot be poked. */
  | { command: 'poke' }
  | { command: 'release' }
  /**
   * Largest force, N; slow motion; whether the hand can turn a block. Absent fields keep their
   * value.
   */
  | { command: 'set_hand'; max_force?: number; careful?: boolean; can_turn?: boolean }
  /** Changes the blocks gradually. Stiffness in N/m; null for that of the contacts. */
  | { command: 'set_blocks'; form: Form; spring_stiffness: number | null }
  /** The player whose turn it is gives up. */
  | { command: 'resign' };

/** A loaded contact of a body; `other` is null for the table. */
export interface Contact {
  other: number | null;
  point: Vec;
  /** Direction in which the other body presses on this one. */
  normal: Vec;
  /** N. */
  force: number;
}

/** State of a hand that holds a block. */
export interface HandUpdate {
  body: number;
  grip: Grip;
  mode: GripMode;
  /** Grasped point in the body's frame, m. */
  anchor: Vec;
  /**
   * Directions in which the goal can be moved, unit vectors: along and across, or inwards. Empty
   * for a carried block.
   */
  axes: Vec[];
  /** Force of the hand on the block, N. */
  force: Vec;
  /** True while the force is at its limit. */
  capped: boolean;
  /** Grasped point, m. */
  point: Vec;
  /** Limited target that pulls the grasped point, m. */
  target: Vec;
  /** Position that the player wants for the grasped point, m. */
  goal: Vec;
  /** Orientation that the player wants; null leaves it free. */
  orientation: Quat | null;
  placing: boolean;
  poking: boolean;
  slot: SlotId | null;
  /** Simulated time for which the block has not moved at full force, s. */
  stuck_s: number;
  contacts: Contact[];
}

/** Rules that a player broke; `body` is the block that it is about. */
export interface Illegal {
  rule:
    | 'over'
    | 'not_over'
    | 'too_high'
    | 'bottom_row'
    | 'not_in_tower'
    | 'not_thrown'
    | 'put_back_first'
    | 'must_take'
    | 'one_block'
    | 'not_taken_out'
    | 'too_strong'
    | 'block_form';
  body?: number;
}

/** Face of the die: rows and cells that it allows. */
export interface Throw {
  row: 'even' | 'odd';
  cell: 'middle' | 'end' | 'any';
}

/** Players count from 0. */
export type GameEvent =
  | { event: 'grasped'; body: number }
  | { event: 'released'; body: number }
  | { event: 'placed'; body: number; slot: SlotId }
  | { event: 'poked'; body: number }
  /** The bodies that fell in this step. */
  | { event: 'fell'; bodies: number[] }
  | { event: 'refused'; reason: string }
  | { event: 'illegal'; rule: Illegal; reason: string }
  | { event: 'turn_started'; player: number; number: number }
  | { event: 'thrown'; throw: Throw }
  | { event: 'nudged'; player: number; body: number }
  | { event: 'put_back'; player: number; body: number }
  | { event: 'removed'; player: number; body: number }
  | { event: 'settled'; player: number }
  | { event: 'scored'; player: number; points: number }
  | { event: 'resigned'; player: number }
  | { event: 'timed_out'; player: number }
  | { event: 'lost'; player: number }
  | { event: 'won'; player: number }
  | { event: 'rebuilt' };

/** Part of a turn: no block was moved; one was moved; one is out; the tower comes to rest. */
export type Phase = 'choosing' | 'removing' | 'placing' | 'settling' | 'over';

export interface Outcome {
  loser: number | null;
  winner: number | null;
}

/** State of the turn. Players count from 0. */
export interface TurnState {
  /** From 1. */
  number: number;
  player: number;
  phase: Phase;
  /** Time since the turn began without that of settling, s. */
  elapsed_s: number;
  /** Time left of the turn, s; null without a clock. */
  left_s: number | null;
  /** Block that was moved, taken out or placed in this turn. */
  block: number | null;
  /** Blocks that may be touched now. */
  removable: number[];
  throw: Throw | null;
  /** Points of each player; empty where there is no score. */
  scores: number[];
  /** Players who are out. */
  out: number[];
  outcome: Outcome | null;
}

export type TowerState = 'standing' | 'moving' | 'fallen';

/** Part that the reports of all simulators have. */
export interface TimedReport {
  /** Simulated time, s. */
  time: number;
}

/** Result of a step. Speeds in m/s, lengths in m. */
export interface StepReport extends TimedReport {
  awake: number;
  touching: number;
  /** Deepest overlap, m. */
  penetration: number;
  /** Speed of the fastest body, m/s. */
  max_speed: number;
  /** Bodies frozen in this step because their state was no longer finite. */
  quarantined: number[];
  hand: { force: Vec; torque: Vec; capped: boolean; point: Vec } | null;
}

/** State of a game after a step, with the report of its simulator. */
export interface Update<R extends TimedReport = StepReport> {
  report: R;
  hand: HandUpdate | null;
  /** Free slots for the carried block. */
  slots: Slot[];
  tower: TowerState;
  /** Bodies that have fallen. */
  fallen: number[];
  /** Bodies frozen so far because their state was no longer finite. */
  quarantined: number[];
  /** True when the contact forces are those of rest. */
  at_rest: boolean;
  form: Form;
  /** Current stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  spring_stiffness: number | null;
  /** Absent in free play. */
  turn?: TurnState;
  events: GameEvent[];
}

export function sameSlot(a: SlotId | null, b: SlotId | null): boolean {
  return a === b || (a !== null && b !== null && a.row === b.row && a.cell === b.cell);
}
