// What this device can hold: the cost of one frame, and from it the form of blocks and the stiffness of contacts that leave real time with
// room to spare.
//
// The choice is made when a tower is built and is then part of its scene. It never changes in a tower that stands: the same scene and hand
// must give the same bits, and a block that is tight must not come loose because the device was busy. A device that falls behind slows time,
// and the next tower takes softer contacts, or rigid blocks.

import { FRAME, type Form } from './protocol';

/** What is chosen from, N/m, softest first. */
export const STIFFNESSES = [3e5, 1e6, 3e6];
/** The tower whose frame is measured. */
export const TRIAL = { rows: 18, blocks: 54, stiffness: 1e6 };
/** Blocks have springs inside where the device holds them with contacts as stiff as this at least, N/m: softer ones hide what is loose. */
export const LEAST_WITH_SPRINGS = 1e6;

/**
 * By how much the dearest frames of play cost more than the frame of the trial. In collapses of 18 to 40 rows the worst sixth of a second
 * costs 2.4 to 3.3 times as much a frame with rigid blocks, a tower that stands less than half as much. Springs inside are the same work
 * whatever the tower does: with them it is 1.9 to 2.7 times as much.
 */
const HEADROOM: Record<Form, number> = { rigid: 3.3, lattice: 2.7 };
/** Springs bound the substep where they are stiffer than this part of the contacts. */
const BINDING = 0.5;
/** Time of one stretch of measuring, s: many ticks of a coarse clock, and long enough for many frames of a fast device. */
const STRETCH = 0.04;
/** Steps of measuring. A browser compiles the engine well only while it runs, and a slow device takes longer over it. */
const STEPS = 60;
/** Time of measuring, s, whatever the steps. */
const TIME = { least: 0.25, most: 1 };
/**
 * Cost beyond which springs inside are out of the question once the least time of measuring is over, s: ten times what the device may take,
 * more than what a browser gains by compiling.
 */
const HOPELESS = 4 * FRAME;
/** Steps of play that are judged together. */
const JUDGED = 60;

/** What is asked for; null leaves it to the device, and springs of null are as stiff as the contacts. Stiffness in N/m. */
export interface Wanted {
  form: Form | null;
  stiffness: number | null;
  springs: number | null;
}

const ANYTHING: Wanted = { form: null, stiffness: null, springs: null };

/**
 * Cost of `step`, s, by the clock `now`, s: the mean of its quickest stretch. What makes a stretch slower is the machine being busy with
 * something else, or code that is not yet compiled well; nothing makes one quicker. It is not measured on for a cost beyond `hopeless`, s.
 */
export function measure(step: () => void, now: () => number, hopeless = Infinity): number {
  const begin = now();
  let quickest = Infinity;
  let done = 0;
  let total = 0;
  while (total < TIME.least || (done < STEPS && total < TIME.most && quickest <= hopeless)) {
    const start = now();
    let steps = 0;
    let past = 0;
    while (past < STRETCH) {
      step();
      steps += 1;
      past = now() - start;
    }
    quickest = Math.min(quickest, past / steps);
    done += steps;
    total = now() - begin;
  }
  return quickest;
}

/** The cost of the trial's frame with blocks of a form, s, by the clock `now`, s. */
export function measureForm(form: Form, step: () => void, now: () => number): number {
  return measure(step, now, form === 'lattice' ? HOPELESS : Infinity);
}

/**
 * Cost of a frame over that of the trial's of the same form. It grows with the number of blocks, for each has about as many contacts as any
 * other, and with the number of substeps, which goes with the square root of the stiffness: that of the contacts, or of the `springs` within
 * the blocks where they are what bounds it. So one measurement of each form tells all.
 */
export function load(blocks: number, stiffness: number, springs: number | null = null): number {
  const binding = springs === null ? stiffness : Math.max(springs, BINDING * stiffness);
  return (blocks / TRIAL.blocks) * Math.sqrt(binding / TRIAL.stiffness);
}

/** Whether a device holds blocks of a form in real time where the trial's frame with them costs `cost`, s. */
function holds(form: Form, cost: number, blocks: number, stiffness: number, springs: number | null): boolean {
  return HEADROOM[form] * cost * load(blocks, stiffness, springs) <= FRAME;
}

/** The stiffest contacts that a device holds in real time, N/m, where the trial's frame costs `cost`, s; the softest where it holds none. */
export function stiffest(cost: number, blocks: number, form: Form = 'rigid', springs: number | null = null): number {
  const held = STIFFNESSES.filter(stiffness => holds(form, cost, blocks, stiffness, springs));
  return held[held.length - 1] ?? STIFFNESSES[0];
}

/** What is known of the device: it is measured once with each form, when that is first asked, and then watched at play. */
export class Device {
  private readonly measured: Partial<Record<Form, number>> = {};
  /** Cost of the trial's frame that play has shown, s; 0 while the device kept up. */
  private readonly shown: Record<Form, number> = { rigid: 0, lattice: 0 };
  private readonly recent: number[] = [];

  /** `trial` measures the cost of the trial's frame with blocks of a form, s. */
  constructor(private readonly trial: (form: Form) => number) {}

  /** The form of blocks and the stiffness of contacts (N/m) for a new tower of so many blocks. */
  choose(blocks: number, wanted: Wanted = ANYTHING): { form: Form; stiffness: number } {
    const form = wanted.form ?? (this.holdsSprings(blocks, wanted) ? 'lattice' : 'rigid');
    return { form, stiffness: wanted.stiffness ?? stiffest(this.cost(form), blocks, form, wanted.springs) };
  }

  private holdsSprings(blocks: number, { stiffness, springs }: Wanted): boolean {
    return holds(
      'lattice',
      this.cost('lattice'),
      blocks,
      stiffness ?? LEAST_WITH_SPRINGS,
      springs ?? stiffness ?? LEAST_WITH_SPRINGS,
    );
  }

  private cost(form: Form): number {
    return Math.max((this.measured[form] ??= this.trial(form)), this.shown[form]);
  }

  /** A new tower is played. */
  begin(): void {
    this.recent.length = 0;
  }

  /**
   * A step of play took `cost`, s. A second in which most steps took longer than the time that they cover is a measurement too: that
   * stiffness is more than the device can hold with that form. It does not grow faster again until the page is loaded anew.
   */
  played(cost: number, blocks: number, stiffness: number, form: Form = 'rigid', springs: number | null = null): void {
    this.recent.push(cost);
    if (this.recent.length < JUDGED) return;
    const median = this.recent.sort((a, b) => a - b)[JUDGED / 2];
    if (median > FRAME)
      this.shown[form] = Math.max(this.shown[form], median / (HEADROOM[form] * load(blocks, stiffness, springs)));
    this.recent.length = 0;
  }
}
