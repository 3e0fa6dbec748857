// `window.teeter`: a look into the page for tests and the curious. Nothing here changes anything.

import type { Constant, Contact, Form } from './protocol';

export interface Inspect {
  readonly ready: boolean;
  /** Simulated time, s. */
  readonly time: number;
  readonly factor: number;
  readonly capacity: number;
  readonly fps: number;
  readonly awake: number;
  readonly state: string;
  readonly paused: boolean;
  readonly count: number;
  readonly quality: string;
  /** Of the contacts, N/m. */
  readonly stiffness: Constant<number>;
  /** What the blocks are. */
  readonly form: Constant<Form>;
  /** Stiffness of the springs within the blocks, N/m; null where they are rigid. */
  readonly springs: number | null;
  /** The springs view: whether it is on, how many springs it shows, and the force at the end of its scale, N. */
  readonly view: { springs: boolean; shown: number; scale: number };
  /** The X-ray: whether it is on, force that starts each block and normal force on its upper face (N; null while the tower moves), and what is written on blocks that are seen. */
  readonly xray: { on: boolean; pulls: (number | null)[] | null; loads: number[] | null; shown: number };
  /** Seven numbers a body: position (m), orientation (x, y, z, w). */
  readonly poses: number[];
  /** Three numbers a body, m. */
  readonly sizes: number[];
  readonly camera: { azimuth: number; elevation: number; position: number[] };
  /** What the hand does, if anything. */
  readonly hand: {
    body: number;
    grip: string;
    force: number;
    capped: boolean;
    placing: boolean;
    slot: number[] | null;
    holders: number[];
  } | null;
  /** Centres of the free slots for the block in the hand, m. */
  readonly slots: number[][];
  readonly quarantined: number[];
  /** Longest time that the page's own thread was held, ms: by a message of the worker, by one picture. */
  readonly longest: { physics: number; picture: number };
  hash(): Promise<{ hash: string; time: number }>;
  contacts(body: number): Promise<Contact[]>;
  /** Screen position (CSS px) of a point of a block as it was made (m from its centre; the centre if not given). */
  screenOf(body: number, local?: [number, number, number]): { x: number; y: number };
  /** Screen position (CSS px) of a point in the world, m. */
  project(point: [number, number, number]): { x: number; y: number };
  /** The block that is seen at a place on the screen. */
  blockAt(x: number, y: number): number | null;
}

declare global {
  interface Window {
    teeter: Inspect;
  }
}
