// Changes the blocks of a standing tower gradually, so that it keeps standing.
//
// Soft springs are compressed: stiffened at once they would hold a thousand times the energy, and a tower that sank by 20 mm would be thrown
// to the ceiling. So the stiffness changes by a small factor a step, and blocks change their form only where springs are so stiff that either
// form looks the same. The steps follow from the commands alone, never from a clock.

import type { Blocks } from './simulator';

/** Factor by which the stiffness changes a step: three decades in two seconds. */
const FACTOR = 1.06;
/** Stiffness at which springs may become rigid, N/m: a tower of 18 rows then moves by a twentieth of a millimetre. */
const FIRM = 1e6;

export class StiffnessRamp {
  private target: Blocks;
  /** Stiffness at which the form changes, N/m. */
  private readonly firm: number;

  /** `contacts`: stiffness of the contacts, N/m. */
  constructor(
    private current: Blocks,
    contacts: number,
  ) {
    this.target = current;
    this.firm = Math.max(FIRM, contacts);
  }

  setTarget(blocks: Blocks): void {
    this.target = blocks;
  }

  /** Returns the blocks for the next step; null where they do not change. */
  next(): Blocks | null {
    const { current, target } = this;
    if (current.form === 'rigid') {
      if (target.form === 'rigid') return null;
      return (this.current = { form: 'lattice', springs: Math.max(target.springs, this.firm) });
    }
    const goal = target.form === 'lattice' ? target.springs : Math.max(current.springs, this.firm);
    if (current.springs !== goal) {
      const springs =
        goal > current.springs ? Math.min(goal, current.springs * FACTOR) : Math.max(goal, current.springs / FACTOR);
      return (this.current = { form: 'lattice', springs });
    }
    return target.form === 'rigid' ? (this.current = target) : null;
  }
}
