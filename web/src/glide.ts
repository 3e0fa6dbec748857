// How the blocks of a standing tower change: gradually, so that it stands through it.
//
// The springs of a soft block are wound up. Made stiff at once they would hold a thousand times the energy, and a tower squashed by 20 mm
// would be thrown to the ceiling. So their stiffness goes to the wanted one by a small factor a step, and blocks become rigid, or get their
// first springs, only where springs are so stiff that either form is the same to the eye. The steps follow from the wishes alone, never
// from a clock: the same wishes at the same steps give the same bits.

import type { Form } from './protocol';

/** Factor a step by which the stiffness of springs changes: three decades in two seconds, in which a squashed tower rises without a hop. */
const FACTOR = 1.06;
/** Springs as stiff as this may become rigid, N/m: a tower of 18 rows then moves by a twentieth of a millimetre. */
const FIRM = 1e6;

/** What blocks are: their form and the stiffness of the springs within them, N/m (of no meaning where they are rigid). */
export interface Blocks {
  form: Form;
  springs: number;
}

export class Glide {
  private wanted: Blocks;
  /** Stiffness at which springs come and go, N/m. */
  private readonly firm: number;

  /** `contacts`: stiffness of the contacts, N/m. */
  constructor(
    private now: Blocks,
    contacts: number,
  ) {
    this.wanted = now;
    this.firm = Math.max(FIRM, contacts);
  }

  want(blocks: Blocks): void {
    this.wanted = blocks;
  }

  /** What the blocks are to be made before the next step; null where they stay as they are. */
  next(): Blocks | null {
    const { now, wanted } = this;
    if (now.form === 'rigid') {
      if (wanted.form === 'rigid') return null;
      return (this.now = { form: 'lattice', springs: Math.max(wanted.springs, this.firm) });
    }
    const goal = wanted.form === 'lattice' ? wanted.springs : Math.max(now.springs, this.firm);
    if (now.springs !== goal) {
      const springs = goal > now.springs ? Math.min(goal, now.springs * FACTOR) : Math.max(goal, now.springs / FACTOR);
      return (this.now = { form: 'lattice', springs });
    }
    return wanted.form === 'rigid' ? (this.now = wanted) : null;
  }
}
