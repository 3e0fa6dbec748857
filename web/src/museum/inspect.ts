// `window.museum`: read-only access to the museum for tests and curious users.

import { Vector3 } from 'three';
import type { Stage } from '../app/stage';
import type { Hand } from '../hand/hand';
import type { Pointers } from '../hand/pointers';
import type { PlaneInspect } from './exhibit-view';
import type { Method, MuseumFrame, Show } from './protocol';
import type { Hand2003 } from './hand-2003';
import type { ConstantValues, Report2003 } from './protocol';
import type { MuseumStore } from './state';

/** Parts that only the tower of 2003 has. */
export interface Inspect2003 {
  /** Hand of 2003 as its simulator reports it; null while it holds nothing. */
  readonly hand: Report2003['hand'];
  /** Velocity of the fastest block of 2003 in any frame of this world, m/s. */
  readonly maxSpeed: number;
  /** Blocks of the tower of 2003 that are disabled. */
  readonly disabled: number[];
  /** Constants that are not at their defaults. */
  readonly constants: ConstantValues;
}

export interface TowerInspect {
  /** Number of the world, which grows with each build. */
  readonly world: number;
  /** Position of the camera, m. */
  readonly camera: number[];
  /** The camera's z axis. */
  readonly towardViewer: number[];
  readonly ready: boolean;
  readonly show: Show;
  /** Simulated time, s. */
  readonly time: number;
  readonly count: number;
  /** Seven numbers per block of the tower in wood: position (m), orientation (x, y, z, w). */
  readonly poses: number[];
  /** Poses of the ghost; null without one. */
  readonly ghost: number[] | null;
  /** Three numbers per block, m. */
  readonly sizes: number[];
  readonly hand: { body: number; grip: string } | null;
  /** True once a block has fallen. */
  readonly fallen: boolean;
  readonly of2003: Inspect2003;
  readonly costs: MuseumFrame['costs'] | null;
  /** Number of springs in the picture. */
  readonly springs: number;
  /** Screen position (CSS px) of a point of a block (m from its centre). */
  screenOf(body: number, local?: [number, number, number]): { x: number; y: number };
  /** Visible block at a position of the picture (CSS px). */
  blockAt(x: number, y: number): number | null;
}

export interface MuseumInspect {
  readonly tower: TowerInspect | null;
  plane(method: Method): PlaneInspect;
  /** Position on an exhibit's canvas (CSS px) of a position in its plane (m). */
  planeAt(method: Method, x: number, y: number): { x: number; y: number };
}

declare global {
  interface Window {
    museum: MuseumInspect;
  }
}

/** Parts of the tower that are inspected. */
export interface InspectedTower {
  store: MuseumStore;
  stage: Stage;
  hand: Hand;
  pointers: Pointers;
  oldHand: Hand2003;
  maxSpeed(): number;
}

export function createTowerInspect(tower: InspectedTower): TowerInspect {
  const { store, stage, hand, pointers } = tower;
  const frame = () => store.state.frame;
  return {
    of2003: inspect2003(tower),
    get ready() {
      return frame() !== null && stage.drawn;
    },
    get show() {
      return store.state.setup.show;
    },
    get world() {
      return store.state.world?.world ?? 0;
    },
    get camera() {
      return stage.orbit.camera.position.toArray();
    },
    get towardViewer() {
      return stage.orbit.forward().negate().toArray();
    },
    get time() {
      return frame()?.update.report.time ?? 0;
    },
    get count() {
      return stage.bodies?.count ?? 0;
    },
    get poses() {
      return Array.from(stage.bodies?.newest ?? []);
    },
    get ghost() {
      const ghost = frame()?.ghost;
      return ghost ? Array.from(ghost.poses) : null;
    },
    get sizes() {
      return Array.from(stage.bodies?.sizes ?? []);
    },
    get hand() {
      return hand.holds ? { body: hand.body!, grip: hand.held?.grip ?? 'slide' } : null;
    },
    get fallen() {
      return frame()?.update.tower === 'fallen';
    },
    get costs() {
      return frame()?.costs ?? null;
    },
    get springs() {
      return stage.view.springsShown;
    },
    screenOf(body, local = [0, 0, 0]) {
      const bodies = stage.bodies!;
      return stage.orbit.project(bodies.surface(body, new Vector3(...local), bodies.newest));
    },
    blockAt: (x, y) => pointers.pickAt(x, y)?.body ?? null,
  };
}

function inspect2003({ store, oldHand, maxSpeed }: InspectedTower): Inspect2003 {
  return {
    get hand() {
      return oldHand.holds ? (store.state.frame?.old?.hand ?? null) : null;
    },
    get maxSpeed() {
      return maxSpeed();
    },
    get disabled() {
      return store.state.frame?.old?.disabled ?? [];
    },
    get constants() {
      return store.state.setup.constants;
    },
  };
}
