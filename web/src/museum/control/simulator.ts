// A tower that can be stepped with a hand.

import type { Contact, Grip, Quat, StepReport, Vec } from '../../engine/game-protocol';

/** Hand of one step, as the engine takes it. Lengths in m, force in N, torque in N m. */
export interface HandTarget {
  body: number;
  anchor: Vec;
  target: Vec;
  /** Null leaves the orientation free. */
  orientation: Quat | null;
  grip: Grip;
  /** Direction of a push, unit vector. */
  axis: Vec;
  max_force: number;
  max_torque: number;
}

export interface Simulator {
  readonly length: number;
  /** Edge lengths, three numbers per body, m. */
  readonly sizes: Float32Array;
  /**
   * Distance of the particles from the block's centre along each axis, as a fraction of half the
   * edge.
   */
  readonly particleOffset: number;
  /** Stiffness of a hand without a force limit, N/m; null where the force is limited. */
  readonly handStiffness: number | null;
  /** A view that the next step may invalidate: seven numbers per body. */
  poses(): Float64Array;
  /** Particles where they have visibly deformed a block, else null. */
  deformed(): Float32Array | null;
  contacts(body: number): Contact[];
  step(hand: HandTarget | null): StepReport;
}
