// The exhibits in the plane: their texts, scenes and counters.

import { count as whole, text } from '../messages';
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
  /** Name of the iterations of a step; empty for a method without iterations. */
  iterations: string;
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
const PLANE = text.museum.plane;
/** Blocks that fall, and blocks at rest. */
const falling = (n: number, speed: number) => of(PLANE.fall(n), 'falling', n, speed);
const stack = (n: number) => of(PLANE.rest(n), 'stack', n);
const section = of(PLANE.section, 'tower', 1);

const cut: Exhibit['counters'][number] = [PLANE.cut, c => whole(c.cut)];
const overlap: Exhibit['counters'][number] = [PLANE.overlap, c => text.readouts.millimetres(1000 * c.overlap, 3)];

export const EXHIBITS: readonly Exhibit[] = [
  {
    method: 'constraint',
    ...PLANE.exhibits['constraint'],
    sceneries: [falling(8, 0.1), falling(3, 0.1), stack(8), section],
    limit: 1000,
    counters: [
      cut,
      [PLANE.restingPoints, c => whole(c.points)],
      [PLANE.unsolved, c => PLANE.steps(c.unsolved)],
      [PLANE.axes, c => whole(c.tests)],
    ],
  },
  {
    method: 'springs',
    ...PLANE.exhibits['springs'],
    sceneries: [falling(8, 0.1), stack(8), of(PLANE.softBlocks, 'falling', 5, 1, 400), section],
    limit: 20,
    counters: [cut, [PLANE.edges, c => whole(c.tests)]],
  },
  {
    method: 'penalty',
    ...PLANE.exhibits['penalty'],
    sceneries: [stack(8), falling(8, 0.1), of(PLANE.softContacts, 'stack', 8, 1, 300), section],
    limit: null,
    counters: [overlap, [PLANE.contactPoints, c => whole(c.points)]],
  },
  {
    method: 'micro-collisions',
    ...PLANE.exhibits['micro-collisions'],
    sceneries: [stack(3), stack(8), falling(8, 0.1), section],
    limit: 1000,
    counters: [cut, overlap, [PLANE.contactPoints, c => whole(c.points)]],
  },
];
