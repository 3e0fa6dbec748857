// Chooses the form of the blocks and the stiffness of the contacts that this device runs in real
// time with room to spare.
//
// The choice is made when a tower is built and is then part of its scene. It never changes in a
// standing tower: the same scene and commands must give the same bits, and a tight block must not
// come loose because the device was busy. A device that falls behind slows time, and the next tower
// takes softer contacts, or rigid blocks.

import { FRAME, type Form } from './game-protocol';

/** Choices of contact stiffness, N/m, softest first. */
export const STIFFNESSES = [3e5, 1e6, 3e6];
/** Tower whose frame is measured. */
export const CALIBRATION = { rows: 18, blocks: 54, stiffness: 1e6 };
/**
 * Smallest contact stiffness with which springs inside the blocks are chosen, N/m: softer contacts
 * hide which blocks are loose.
 */
export const MIN_WITH_SPRINGS = 1e6;

/**
 * Ratio of the most expensive frames of play to the calibration frame. In collapses of 18 to 40
 * rows the worst sixth of a second costs 2.4 to 3.3 times as much a frame with rigid blocks, and
 * 1.9 to 2.7 times as much with springs inside, whose cost depends less on the motion.
 */
const HEADROOM: Record<Form, number> = { rigid: 3.3, lattice: 2.7 };
/** Fraction of the contact stiffness from which springs bound the substep. */
const BINDING = 0.5;
/** Duration of one sample, s: many ticks of a coarse clock, and many frames of a fast device. */
const SAMPLE = 0.04;
/**
 * Steps to measure: browsers optimise the engine while it runs, and a slow device takes longer to
 * do so.
 */
const STEPS = 60;
/** Bounds of the duration of a measurement, s. */
const DURATION = { min: 0.25, max: 1 };
/**
 * Cost beyond which springs inside are not measured longer than the minimum, s: ten times the
 * budget, more than optimisation gains.
 */
const HOPELESS = 4 * FRAME;
/** Steps of play per sample. */
const PLAY_SAMPLE = 60;

/**
 * Requested constants, stiffness in N/m. Null leaves the choice to the device; springs of null are
 * as stiff as the contacts.
 */
export interface Wanted {
  form: Form | null;
  stiffness: number | null;
  springs: number | null;
}

const ANYTHING: Wanted = { form: null, stiffness: null, springs: null };

/**
 * Returns the cost of `step`, s, by the clock `now`, s: the mean over the fastest sample. Other
 * work on the machine and code that is not yet optimised only make samples slower. A cost beyond
 * `hopeless` (s) ends the measurement after its minimum duration.
 */
export function measure(step: () => void, now: () => number, hopeless = Infinity): number {
  const begin = now();
  let fastest = Infinity;
  let done = 0;
  let total = 0;
  while (total < DURATION.min || (done < STEPS && total < DURATION.max && fastest <= hopeless)) {
    const start = now();
    let steps = 0;
    let elapsed = 0;
    while (elapsed < SAMPLE) {
      step();
      steps += 1;
      elapsed = now() - start;
    }
    fastest = Math.min(fastest, elapsed / steps);
    done += steps;
    total = now() - begin;
  }
  return fastest;
}

/** Returns the cost of the calibration frame with blocks of a form, s, by the clock `now`, s. */
export function measureForm(form: Form, step: () => void, now: () => number): number {
  return measure(step, now, form === 'lattice' ? HOPELESS : Infinity);
}

/**
 * Returns the ratio of the cost of a frame to that of the calibration frame of the same form. It is
 * proportional to the number of blocks and to the number of substeps, which grows with the square
 * root of the stiffness of the contacts, or of the `springs` where they bound it.
 */
export function load(blocks: number, stiffness: number, springs: number | null = null): number {
  const binding = springs === null ? stiffness : Math.max(springs, BINDING * stiffness);
  return (blocks / CALIBRATION.blocks) * Math.sqrt(binding / CALIBRATION.stiffness);
}

/**
 * Returns true if a device on which the calibration frame costs `cost` (s) runs blocks of a form in
 * real time.
 */
function runsInRealTime(form: Form, cost: number, blocks: number, stiffness: number, springs: number | null): boolean {
  return HEADROOM[form] * cost * load(blocks, stiffness, springs) <= FRAME;
}

/**
 * Returns the stiffest contacts that run in real time where the calibration frame costs `cost` (s),
 * N/m; the softest if none do.
 */
export function maxStiffness(
  cost: number,
  blocks: number,
  form: Form = 'rigid',
  springs: number | null = null,
): number {
  const possible = STIFFNESSES.filter(stiffness => runsInRealTime(form, cost, blocks, stiffness, springs));
  return possible[possible.length - 1] ?? STIFFNESSES[0];
}

/** Speed of the device: measured once with each form, on demand, and then observed during play. */
export class Device {
  private readonly measured: Partial<Record<Form, number>> = {};
  /** Cost of the calibration frame derived from play, s; 0 while the device kept up. */
  private readonly observed: Record<Form, number> = { rigid: 0, lattice: 0 };
  private readonly recent: number[] = [];

  /** `calibrate` measures the cost of the calibration frame with blocks of a form, s. */
  constructor(private readonly calibrate: (form: Form) => number) {}

  /**
   * Returns the form of the blocks and the stiffness of the contacts (N/m) for a new tower of
   * `blocks` blocks.
   */
  choose(blocks: number, wanted: Wanted = ANYTHING): { form: Form; stiffness: number } {
    const form = wanted.form ?? (this.runsSprings(blocks, wanted) ? 'lattice' : 'rigid');
    return { form, stiffness: wanted.stiffness ?? maxStiffness(this.cost(form), blocks, form, wanted.springs) };
  }

  private runsSprings(blocks: number, { stiffness, springs }: Wanted): boolean {
    return runsInRealTime(
      'lattice',
      this.cost('lattice'),
      blocks,
      stiffness ?? MIN_WITH_SPRINGS,
      springs ?? stiffness ?? MIN_WITH_SPRINGS,
    );
  }

  private cost(form: Form): number {
    return Math.max((this.measured[form] ??= this.calibrate(form)), this.observed[form]);
  }

  /** Begins observing a new tower. */
  begin(): void {
    this.recent.length = 0;
  }

  /**
   * Takes the cost of a step of play, s. A sample in which most steps exceeded the time they cover
   * counts as a measurement until the page is loaded again.
   */
  played(cost: number, blocks: number, stiffness: number, form: Form = 'rigid', springs: number | null = null): void {
    this.recent.push(cost);
    if (this.recent.length < PLAY_SAMPLE) return;
    const median = this.recent.sort((a, b) => a - b)[PLAY_SAMPLE / 2];
    if (median > FRAME)
      this.observed[form] = Math.max(this.observed[form], median / (HEADROOM[form] * load(blocks, stiffness, springs)));
    this.recent.length = 0;
  }
}
