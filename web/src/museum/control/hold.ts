// A block in the hand, and the constants of the hand.

import type { Quaternion, Vector3 } from 'three';
import type { Contact, Grip, GripMode, Vec } from '../../engine/game-protocol';
import type { FreeSlot } from './slots';
import type { TargetLimiter } from './target-limiter';

/** Torque of the hand, N m: holds a block level by its end. */
export const TORQUE = 0.02;
/** Largest speeds of the target, m/s. */
export const SPEED: Record<Grip | 'careful' | 'poke', number> = {
  slide: 0.25,
  carry: 0.5,
  push: 0.12,
  careful: 0.03,
  poke: 0.04,
};
/** Largest distance of the target from the grasped point, m. */
export const LEAD: Record<Grip, number> = { slide: 0.012, carry: 0.03, push: 0.012 };
/**
 * Fractions of the largest force: from the first the hand is shown as at its limit, from the second
 * its target gains no lead.
 */
export const CAPPED = 0.97;
export const SATURATED = 0.98;
/** Largest distance of the goal from the grasped point, m: a reversal is felt at once. */
export const STRETCH = 0.06;
/** Depth, m, and duration, s, of a poke. */
export const POKE = { depth: 0.006, seconds: 0.35 };
/** Displacement up to which a block can be poked, m. */
export const UNMOVED = 0.004;
/** Vertical component of a face's normal up to which the face can be poked. */
export const UPRIGHT = 0.5;
/**
 * Height above its slot below which a block that touches stands in it, m: more would be the edge of
 * a neighbour.
 */
export const STANDING = 0.002;
/** Force on a block from below by which it stands, N. */
export const SUPPORT = 0.03;
/** Angle up to which a hand that cannot turn a block fits it into a slot, rad. */
export const ALIGNED = 0.2;
/** Simulated time after which a block that does not come down is released, s. */
export const PATIENCE = 6;
/** Angle within which a block that is lifted is levelled, rad. */
export const LEVELLING = 0.3;
/** Displacement between two steps below which a block at full force is stuck, m. */
export const STUCK = 2e-5;

export interface Hold {
  body: number;
  anchor: Vector3;
  /** Inward normal of the touched face. */
  axis: Vector3;
  mode: GripMode;
  grip: Grip;
  /** Position that the player wants for the grasped point, m. */
  goal: Vector3;
  /** Grasped point when it was grasped, m. */
  start: Vector3;
  orientation: Quaternion | null;
  /** True once the block has come clear of the tower and is to stay clear. */
  clear: boolean;
  slot: FreeSlot | null;
  placing: boolean;
  poking: boolean;
  /** Simulated time at which placing or poking began, s. */
  since: number;
  limiter: TargetLimiter | null;
  /** Grasped point (m), force (N) and contacts of the last step. */
  point: Vector3;
  force: Vec;
  capped: boolean;
  contacts: Contact[];
  /** s. */
  stuckFor: number;
}
