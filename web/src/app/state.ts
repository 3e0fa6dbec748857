// Fields of the page's state.

import type { Form, GripMode, TimedReport } from '../engine/game-protocol';
import type {
  BlockPreset,
  Built,
  ComputerPlayer,
  Constant,
  Frame,
  RulesChoice,
  SceneEntry,
  SceneSource,
  Setup,
} from '../engine/protocol';
import type { Match } from '../modes/match';
import { recallSound } from '../sound/remembered';
import type { Reading } from '../xray/readings';
import { recall } from './memory';
import type { Store } from './store';
import type { Options } from './url';

/** State that the hand, the pointers and the stage need, in the game and in the museum. */
export interface PlayState<F extends Frame<TimedReport> = Frame<TimedReport>> {
  paused: boolean;
  /** Grip of the next grasp. */
  grip: GripMode;
  /** True while the hand moves slowly. */
  careful: boolean;
  /** Largest force of the hand, N. */
  maxForce: number;
  /** Block that was touched last. */
  selected: number | null;
  /** Block under a resting mouse. */
  hovered: number | null;
  /** True while a pointer is down. */
  pointing: boolean;
  dark: boolean;
  /** True while the player only watches: a replay, or the turn of a computer player. */
  watching: boolean;
  /** The world that is played. */
  world: Built | null;
  /** The last frame of that world: its update is the truth of the game. */
  frame: F | null;
}

/**
 * View of the inside of the tower; springs are drawn in glass and the X-ray on wood, so there is
 * one at a time.
 */
export type Overlay = 'none' | 'springs' | 'xray';

/** Settings that a tower is built with. Stiffness in N/m; null leaves the choice to the device. */
export interface Settings {
  /** Name of a listed scene; null for the tower. */
  scene: string | null;
  rows: number;
  seed: number;
  block: BlockPreset;
  sleep: boolean;
  stiffness: number | null;
  form: Form | null;
  /** Null for springs as stiff as the contacts. */
  springs: number | null;
}

export interface PageState extends PlayState<Frame> {
  settings: Settings;
  scenes: SceneEntry[];
  overlay: Overlay;
  /** X-ray of each block; null while the tower moves. */
  readings: Reading[] | null;
  /** Current blocks: chosen at the build, and changed by the player later. */
  form: Constant<Form>;
  /** Mode, players and rules. */
  match: Match;
  /** Part of the thought of a computer player, 0 to 1; null while none thinks. */
  thinking: number | null;
  /** The safest block of this turn, and the chance that taking it fells the tower; null unknown. */
  safest: { body: number; chance: number } | null;
  /** Simulated time per wall time that the page asks for. */
  speed: number;
  panelOpen: boolean;
  helpOpen: boolean;
  /** Volume of the sound, 0 to 1. */
  volume: number;
  muted: boolean;
  /** True if the phone or the gamepad may vibrate. */
  vibration: boolean;
  menuOpen: boolean;
}

export type PageStore = Store<PageState>;

/** A store whose state includes that of play. */
export interface PlayStore {
  readonly state: Readonly<PlayState>;
  set(change: Partial<PlayState>): void;
  subscribe(keys: readonly (keyof PlayState)[], listener: (state: Readonly<PlayState>) => void): void;
}

export function initialPlay(options: Options): PlayState<never> {
  return {
    paused: false,
    grip: 'auto',
    careful: false,
    maxForce: options.maxForce,
    selected: null,
    hovered: null,
    pointing: false,
    dark: false,
    watching: false,
    world: null,
    frame: null,
  };
}

export function initialPage(options: Options, match: Match): PageState {
  const { scene, rows, seed, block, sleep, stiffness, form, springs } = options;
  return {
    ...initialPlay(options),
    settings: { scene, rows, seed, block, sleep, stiffness, form, springs },
    scenes: [],
    overlay: 'none',
    readings: null,
    form: { value: 'rigid', chosen: false },
    match,
    thinking: null,
    safest: null,
    speed: 1,
    panelOpen: false,
    helpOpen: false,
    ...recallSound(),
    vibration: recall('vibration') !== 'false',
    menuOpen: false,
  };
}

/** Returns the setup of a world with these settings, played by rules. */
export function setupOf(
  { scene, rows, seed, block, ...rest }: Settings,
  rules: RulesChoice | null = null,
  computers: ComputerPlayer[] = [],
): Setup {
  const source: SceneSource = scene ? { kind: 'named', name: scene } : { kind: 'tower', rows, seed, block };
  return { source, ...rest, rules, computers };
}
