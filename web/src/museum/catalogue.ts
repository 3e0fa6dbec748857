// The exhibits in the plane: their texts, scenes and counters.

import type { Method, PlaneCounts, Setting } from './protocol';

export interface Scenery {
  label: string;
  setting: Setting;
  count: number;
  /** m */
  gap: number;
  /** N/m; null for the default. */
  stiffness: number | null;
  /** Default simulated time per wall time. */
  speed: number;
}

export interface Exhibit {
  method: Method;
  title: string;
  chapter: string;
  text: string;
  sceneries: Scenery[];
  /** Name of the iterations of a step; null for a method without iterations. */
  iterations: string | null;
  /** Largest number of iterations of a step; null for a method without iterations. */
  limit: number | null;
  /** Rows of counters: a name, and a formatted value. */
  counters: [string, (counts: PlaneCounts) => string][];
}

const of = (label: string, setting: Setting, count: number, speed = 1, stiffness: number | null = null): Scenery => ({
  label,
  setting,
  count,
  gap: setting === 'falling' ? 0.005 : 0,
  stiffness,
  speed,
});
const section = of('Section of a tower', 'tower', 1);

const whole = (n: number) => n.toLocaleString('en').replaceAll(',', '\u202f');
const cut: Exhibit['counters'][number] = ['Steps cut short', c => whole(c.cut)];
const overlap: Exhibit['counters'][number] = ['Deepest overlap', c => `${(1000 * c.overlap).toFixed(3)} mm`];

export const EXHIBITS: readonly Exhibit[] = [
  {
    method: 'constraint',
    title: 'Constraints',
    chapter: 'Section 3.4.1, Figure 3.3',
    text:
      'The first prototype. Blocks are rigid, each collision is resolved at its time, pair by pair, and Dantzig’s algorithm finds the forces of what rests: ' +
      'the arrows. While one pair is resolved all others are ignored, so resolving one puts its neighbours into each other. A stack that falls onto itself ' +
      'needs ever more iterations; here a limit of 1000 ends the step and puts the rest back. This is why 2003 gave it up.',
    sceneries: [
      of('8 blocks fall', 'falling', 8, 0.1),
      of('3 blocks fall', 'falling', 3, 0.1),
      of('8 blocks at rest', 'stack', 8),
      section,
    ],
    iterations: 'Pairs resolved',
    limit: 1000,
    counters: [
      cut,
      ['Resting contact points', c => whole(c.points)],
      ['Without an answer for them', c => `${whole(c.unsolved)} steps`],
      ['Axes tested in a step', c => whole(c.tests)],
    ],
  },
  {
    method: 'springs',
    title: 'Springs',
    chapter: 'Section 3.4.2, Figures 3.4 and 3.5',
    text:
      'The second prototype. A block is four particles and six springs, and nothing rests, it only collides. Resolving a collision on one side of a block ' +
      'does not knock its other side into the next one, so a couple of rounds over all pairs are enough, however high the stack. The tower above is this ' +
      'with one more dimension.',
    sceneries: [
      of('8 blocks fall', 'falling', 8, 0.1),
      of('8 blocks at rest', 'stack', 8),
      of('Soft blocks', 'falling', 5, 1, 400),
      section,
    ],
    iterations: 'Rounds over the pairs',
    limit: 20,
    counters: [cut, ['Points against edges in a step', c => whole(c.tests)]],
  },
  {
    method: 'penalty',
    title: 'Penalty',
    chapter: 'Section 2.4.2',
    text:
      'Blocks may be inside each other, and a force in proportion to the depth drives them apart. Nothing is repeated, so there is nothing to count; the ' +
      'price is the overlap, and steps of a tenth of a millisecond. The soft stack shows what the stiff one hides.',
    sceneries: [
      of('8 blocks at rest', 'stack', 8),
      of('8 blocks fall', 'falling', 8, 0.1),
      of('Soft contacts', 'stack', 8, 1, 300),
      section,
    ],
    iterations: null,
    limit: null,
    counters: [overlap, ['Contact points', c => whole(c.points)]],
  },
  {
    method: 'micro-collisions',
    title: 'Micro-collisions',
    chapter: 'Section 2.4.2',
    text:
      'Impulses for everything: a block at rest is one that collides very often and very gently. Each blow makes other contacts approach again, so the ' +
      'impulses of a step grow with the height of the stack, and it never quite stops.',
    sceneries: [
      of('3 blocks at rest', 'stack', 3),
      of('8 blocks at rest', 'stack', 8),
      of('8 blocks fall', 'falling', 8, 0.1),
      section,
    ],
    iterations: 'Impulses',
    limit: 1000,
    counters: [cut, overlap, ['Contact points', c => whole(c.points)]],
  },
];
