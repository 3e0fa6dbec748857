// What this device can hold: the cost of one frame, and from it the stiffness of contacts that leaves real time with room to spare.
//
// The choice is made when a tower is built and is then part of its scene. It never changes in a tower that stands: the same scene and hand
// must give the same bits, and a block that is tight must not come loose because the device was busy. A device that falls behind slows time,
// and the next tower takes softer contacts.

import { FRAME } from './protocol';

/** What is chosen from, N/m, softest first. */
export const STIFFNESSES = [3e5, 1e6, 3e6];
/** The tower whose frame is measured. */
export const TRIAL = { rows: 18, blocks: 54, stiffness: 1e6 };

/**
 * By how much the dearest frames of play cost more than the frame of the trial. In collapses of 18 to 40 rows the worst sixth of a second
 * costs 2.4 to 3.3 times as much a frame, a tower that stands less than half as much.
 */
const HEADROOM = 3.3;
/** Time of one stretch of measuring, s: many ticks of a coarse clock, and long enough for many frames of a fast device. */
const STRETCH = 0.04;
/** Steps of measuring. A browser compiles the engine well only while it runs, and a slow device takes longer over it. */
const STEPS = 60;
/** Time of measuring, s, whatever the steps. */
const TIME = { least: 0.25, most: 1 };
/** Steps of play that are judged together. */
const JUDGED = 60;

/**
 * Cost of `step`, s, by the clock `now`, s: the mean of its quickest stretch. What makes a stretch slower is the machine being busy with
 * something else, or code that is not yet compiled well; nothing makes one quicker.
 */
export function measure(step: () => void, now: () => number): number {
  const begin = now();
  let quickest = Infinity;
  let done = 0;
  let total = 0;
  while (total < TIME.least || (done < STEPS && total < TIME.most)) {
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

/**
 * Cost of a frame over that of the trial's. It grows with the number of blocks, for each has about as many contacts as any other, and with
 * the number of substeps, which goes with the square root of the stiffness. So one measurement tells all.
 */
export function load(blocks: number, stiffness: number): number {
  return (blocks / TRIAL.blocks) * Math.sqrt(stiffness / TRIAL.stiffness);
}

/** The stiffest contacts that a device holds in real time, N/m, where the trial's frame costs `cost`, s; the softest where it holds none. */
export function stiffest(cost: number, blocks: number): number {
  const held = STIFFNESSES.filter(stiffness => HEADROOM * cost * load(blocks, stiffness) <= FRAME);
  return held[held.length - 1] ?? STIFFNESSES[0];
}

/** What is known of the device: it is measured once, when it is first asked, and then watched at play. */
export class Device {
  private cost: number | null = null;
  /** Cost of the trial's frame that play has shown, s; 0 while the device kept up. */
  private shown = 0;
  private readonly recent: number[] = [];

  /** `trial` measures the cost of the trial's frame, s. */
  constructor(private readonly trial: () => number) {}

  /** Stiffness for a new tower of so many blocks, N/m. */
  choose(blocks: number): number {
    this.cost ??= this.trial();
    return stiffest(Math.max(this.cost, this.shown), blocks);
  }

  /** A new tower is played. */
  begin(): void {
    this.recent.length = 0;
  }

  /**
   * A step of play took `cost`, s. A second in which most steps took longer than the time that they cover is a measurement too: that
   * stiffness is more than the device can hold. It does not grow faster again until the page is loaded anew.
   */
  played(cost: number, blocks: number, stiffness: number): void {
    this.recent.push(cost);
    if (this.recent.length < JUDGED) return;
    const median = this.recent.sort((a, b) => a - b)[JUDGED / 2];
    if (median > FRAME) this.shown = Math.max(this.shown, median / (HEADROOM * load(blocks, stiffness)));
    this.recent.length = 0;
  }
}
