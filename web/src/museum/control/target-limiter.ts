// Limits the motion of the hand's target.
//
// A hand whose target jumps throws blocks. The target moves at a limited speed and keeps a limited
// lead over the grasped point, so that the force of the hand's spring builds up while a block
// sticks and the target does not run away.

import type { Quat, Vec } from '../../engine/game-protocol';
import { add, length, rotateTowards, scale, sub } from './vectors';

/** Largest angular speed of the target orientation, rad/s. */
const ANGULAR_SPEED = 3;

/** Goal of the target and its limits. */
export interface Goal {
  /** m. */
  target: Vec;
  /** Null leaves the orientation free. */
  orientation: Quat | null;
  /** Largest speed of the target, m/s. */
  speed: number;
  /** Largest distance of the target from the grasped point, m. */
  lead: number;
}

export class TargetLimiter {
  /** Starts at the grasped point, m, with the body's own orientation. */
  constructor(
    private position: Vec,
    private rotation: Quat,
  ) {}

  /**
   * Advances by `dt` seconds towards `goal` from the grasped point. `saturated`: true while the
   * hand is at its force limit.
   */
  advance(goal: Goal, point: Vec, saturated: boolean, dt: number): void {
    const before = length(sub(this.position, point));
    const offset = sub(goal.target, this.position);
    const step = goal.speed * dt;
    this.position = add(this.position, length(offset) > step ? scale(offset, step / length(offset)) : offset);
    // A lead beyond that of the full force would only throw the block when it comes loose.
    const lead = saturated ? Math.min(goal.lead, before) : goal.lead;
    const ahead = sub(this.position, point);
    if (length(ahead) > lead) this.position = add(point, scale(ahead, lead / length(ahead)));
    if (goal.orientation) this.rotation = rotateTowards(this.rotation, goal.orientation, ANGULAR_SPEED * dt);
  }

  target(): Vec {
    return this.position;
  }

  orientation(): Quat {
    return this.rotation;
  }
}
