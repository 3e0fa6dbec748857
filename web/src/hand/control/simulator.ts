// A tower that can be stepped with a hand.

import type { Contact, Form, Grip, Quat, StepReport, Vec } from '../../engine/game-protocol';

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

/** Form of the blocks and stiffness of the springs inside them, N/m (ignored where they are rigid). */
export interface Blocks {
  form: Form;
  springs: number;
}

export interface Simulator {
  readonly length: number;
  /** Edge lengths, three numbers per body, m. */
  readonly sizes: Float32Array;
  /** Distance of the particles from the block's centre along each axis, as a fraction of half the edge. */
  readonly particleOffset: number;
  readonly form: Form;
  /** Stiffness of the contacts, N/m. */
  readonly stiffness: number;
  /** Stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  readonly springStiffness: number | null;
  /** Stiffness of a hand without a force limit, N/m; null where the force is limited. */
  readonly handStiffness: number | null;
  /** A view that the next step may invalidate: seven numbers per body. */
  poses(): Float64Array;
  /** Particles where they have visibly deformed a block, else null. */
  deformed(): Float32Array | null;
  contacts(body: number): Contact[];
  /** Contact forces that rest is detected from; absent where rest is not detected. */
  contactForces?(): Float32Array;
  setBlocks?(blocks: Blocks): void;
  step(hand: HandTarget | null): StepReport;
}
