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
  | { command: 'set_blocks'; form: Form; spring_stiffness: number | null };

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

export type GameEvent =
  | { event: 'grasped'; body: number }
  | { event: 'released'; body: number }
  | { event: 'placed'; body: number; slot: SlotId }
  | { event: 'poked'; body: number }
  /** The bodies that fell in this step. */
  | { event: 'fell'; bodies: number[] }
  | { event: 'refused'; reason: string };

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
  events: GameEvent[];
}

export function sameSlot(a: SlotId | null, b: SlotId | null): boolean {
  return a === b || (a !== null && b !== null && a.row === b.row && a.cell === b.cell);
}
