// `window.museum`: a look into the museum for tests and the curious. Nothing here changes anything.

import type { PlaneInspect } from './exhibit-view';
import type { Method, MuseumFrame, Show } from './protocol';

export interface TowerInspect {
  readonly ready: boolean;
  readonly show: Show;
  /** Simulated time, s. */
  readonly time: number;
  readonly count: number;
  /** Seven numbers a block of the tower in wood: position (m), orientation (x, y, z, w). */
  readonly poses: number[];
  /** The same of the ghost, if there is one. */
  readonly ghost: number[] | null;
  /** Three numbers a block, m. */
  readonly sizes: number[];
  readonly hand: { body: number; grip: string } | null;
  readonly costs: MuseumFrame['costs'] | null;
  /** Number of springs in the picture. */
  readonly springs: number;
  /** Screen position (CSS px) of a point of a block (m from its centre). */
  screenOf(body: number, local?: [number, number, number]): { x: number; y: number };
  /** The block that is seen at a place of the picture (CSS px). */
  blockAt(x: number, y: number): number | null;
}

export interface MuseumInspect {
  readonly tower: TowerInspect | null;
  plane(method: Method): PlaneInspect;
  /** Place on an exhibit's canvas (CSS px) of a place in its plane (m). */
  planeAt(method: Method, x: number, y: number): { x: number; y: number };
}

declare global {
  interface Window {
    museum: MuseumInspect;
  }
}
