// `window.teeter`: read-only access to the page for tests and curious users.

import { Vector3 } from 'three';
import type { Client } from '../engine/client';
import { sameSlot, type Contact, type Form, type TurnState } from '../engine/game-protocol';
import type { Constant, ReplayState, StateHash } from '../engine/protocol';
import type { Hand } from '../hand/hand';
import type { Pointers } from '../hand/pointers';
import type { Sound } from '../sound/sound';
import type { Labels } from '../xray/labels';
import type { Stage } from './stage';
import type { PageStore } from './state';

export interface Inspect {
  /** Number of the world, which grows with each build. */
  readonly world: number;
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
  /** Stiffness of the contacts, N/m. */
  readonly stiffness: Constant<number>;
  readonly form: Constant<Form>;
  /** Stiffness of the springs inside the blocks, N/m; null where they are rigid. */
  readonly springs: number | null;
  /**
   * Springs view: true while it is on, number of springs in the picture, and end of its scale, N.
   */
  readonly view: { springs: boolean; shown: number; scale: number };
  /**
   * X-ray: breakaway force and load of each block (N; null while the tower moves), and number of
   * visible figures.
   */
  readonly xray: { on: boolean; pulls: (number | null)[] | null; loads: number[] | null; shown: number };
  /**
   * State of the audio output, `none` until the first gesture, then that of its context; and number
   * of knocks so far.
   */
  readonly sound: { state: string; knocks: number };
  /** Seven numbers per body: position (m), orientation (x, y, z, w). */
  readonly poses: number[];
  /** Three numbers per body, m. */
  readonly sizes: number[];
  readonly camera: { azimuth: number; elevation: number; position: number[] };
  /** Block that was touched or chosen last. */
  readonly selected: number | null;
  /** The hand that holds a block. */
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
  /** State of the turn; null in free play. */
  readonly turn: TurnState | null;
  /** State of a replay; null in a game. */
  readonly replay: ReplayState | null;
  /** Simulated time of the game that was saved last, s. */
  readonly saved: number;
  /** Poses of the ghost of the best game on the tower of the day; null where none is shown. */
  readonly ghost: number[] | null;
  readonly quarantined: number[];
  /**
   * Longest times for which the page's thread was blocked, ms: by a message of the worker, by one
   * picture.
   */
  readonly longest: { physics: number; picture: number };
  hash(): Promise<StateHash>;
  /** Hashes of the states of all steps until a simulated time, s. */
  hashes(until: number): Promise<StateHash[]>;
  /** Record of the game so far, with its state, as bytes. */
  record(): Promise<number[]>;
  contacts(body: number): Promise<Contact[]>;
  /**
   * Screen position (CSS px) of a point of an unstrained block, m from its centre; the centre by
   * default.
   */
  screenOf(body: number, local?: [number, number, number]): { x: number; y: number };
  /** Screen position (CSS px) of a point in the world, m. */
  project(point: [number, number, number]): { x: number; y: number };
  /** Visible block at a position on the screen, CSS px. */
  blockAt(x: number, y: number): number | null;
}

declare global {
  interface Window {
    teeter: Inspect;
  }
}

/** Parts of the page that are inspected. */
export interface Inspected {
  store: PageStore;
  stage: Stage;
  hand: Hand;
  pointers: Pointers;
  labels: Labels;
  client: Client;
  sound: Sound;
  games: { readonly saved: number; readonly ghost: Float32Array | null };
}

type Methods = 'hash' | 'hashes' | 'record' | 'contacts' | 'screenOf' | 'project' | 'blockAt';
type Getters = { [K in Exclude<keyof Inspect, Methods>]: () => Inspect[K] };

export function createInspect(page: Inspected): Inspect {
  const { stage, pointers, client } = page;
  const { orbit } = stage;
  const methods: Pick<Inspect, Methods> = {
    hash: () => client.ask({ what: 'hash' }),
    hashes: until => client.ask({ what: 'hashes', until }),
    async record() {
      const record = await client.ask({ what: 'record', state: true });
      return Array.from(record?.bytes ?? []);
    },
    contacts: body => client.ask({ what: 'contacts', body }),
    screenOf(body, local = [0, 0, 0]) {
      const bodies = stage.bodies!;
      return orbit.project(bodies.surface(body, new Vector3(...local), bodies.newest));
    },
    project: point => orbit.project(new Vector3(...point)),
    blockAt: (x, y) => pointers.pickAt(x, y)?.body ?? null,
  };
  const getters = Object.entries({ ...gameGetters(page), ...viewGetters(page) } satisfies Getters);
  return Object.freeze(
    Object.defineProperties(
      methods,
      Object.fromEntries(getters.map(([name, get]) => [name, { get, enumerable: true }])),
    ) as Inspect,
  );
}

function gameGetters({ store, stage, hand, games }: Inspected) {
  const frame = () => store.state.frame;
  const report = () => frame()?.update.report;
  return {
    ready: () => frame() !== null && stage.drawn,
    world: () => store.state.world?.world ?? 0,
    time: () => report()?.time ?? 0,
    factor: () => frame()?.factor ?? 0,
    capacity: () => frame()?.capacity ?? 0,
    awake: () => report()?.awake ?? 0,
    state: () => frame()?.update.tower ?? 'standing',
    paused: () => store.state.paused,
    count: () => stage.bodies?.count ?? 0,
    stiffness: () => store.state.world?.stiffness ?? { value: 0, chosen: false },
    form: () => store.state.form,
    springs: () => (frame() ? frame()!.update.spring_stiffness : (store.state.world?.springs ?? null)),
    poses: () => Array.from(stage.bodies?.newest ?? []),
    sizes: () => Array.from(stage.bodies?.sizes ?? []),
    turn: () => frame()?.update.turn ?? null,
    replay: () => frame()?.replay ?? null,
    saved: () => games.saved,
    ghost: () => games.ghost && [...games.ghost],
    quarantined: () => frame()?.update.quarantined ?? [],
    selected: () => store.state.selected,
    hand: () => handFields(hand),
    slots: () => hand.slots.map(slot => slot.position as number[]),
  };
}

function handFields(hand: Hand): Inspect['hand'] {
  if (!hand.holds) return null;
  const { held, slots } = hand;
  return {
    body: hand.body!,
    grip: held?.grip ?? 'slide',
    force: Math.hypot(...(held?.force ?? [0, 0, 0])),
    capped: held?.capped ?? false,
    placing: hand.gesture === 'placing',
    slot: slots.find(slot => sameSlot(slot, held?.slot ?? null))?.position ?? null,
    holders: hand.holders()?.bodies ?? [],
  };
}

function viewGetters({ store, stage, labels, client, sound }: Inspected) {
  const { orbit, view } = stage;
  return {
    fps: () => stage.fps,
    quality: () => stage.quality.tier.name,
    sound: () => sound.played,
    view: () => ({ springs: store.state.overlay === 'springs', shown: view.springsShown, scale: stage.forces.end }),
    xray: () => ({
      on: store.state.overlay === 'xray',
      pulls: store.state.readings?.map(r => r.pull) ?? null,
      loads: store.state.readings?.map(r => r.load) ?? null,
      shown: labels.shown,
    }),
    camera: () => ({
      azimuth: orbit.azimuth,
      elevation: orbit.elevation,
      position: orbit.camera.position.toArray() as number[],
    }),
    longest: () => ({ physics: client.maxMessageTime, picture: stage.maxPictureTime }),
  };
}
