// The hand's target on its way to where the player wants it.
//
// A hand that jumped would throw blocks. The target moves at a limited speed and stays within reach of the grasped point, so that the
// force of the hand's spring builds up while a block sticks and the target does not run away from it.

import type { Quat, Vec, Wish } from './protocol';
import { add, length, scale, sub, turnTowards } from './vectors';

/** Largest turn of the wanted orientation, rad/s. */
const TURN_SPEED = 3;

export class Leash {
  /** Starts at the grasped point, with the body's own orientation. */
  constructor(
    private at: Vec,
    private turned: Quat,
  ) {}

  /** Moves on by `dt` seconds towards `wish`, from the grasped point `point`. `spent`: the hand gives all the force it has. */
  advance(wish: Wish, point: Vec, spent: boolean, dt: number): void {
    const before = length(sub(this.at, point));
    const way = sub(wish.target, this.at);
    const reach = wish.speed * dt;
    this.at = add(this.at, length(way) > reach ? scale(way, reach / length(way)) : way);
    // More lead than the whole force needs would only throw the block when it comes loose.
    const lead = spent ? Math.min(wish.lead, before) : wish.lead;
    const ahead = sub(this.at, point);
    if (length(ahead) > lead) this.at = add(point, scale(ahead, lead / length(ahead)));
    if (wish.orientation) this.turned = turnTowards(this.turned, wish.orientation, TURN_SPEED * dt);
  }

  target(): Vec {
    return this.at;
  }

  orientation(): Quat {
    return this.turned;
  }
}
