// Keyboard shortcuts of the game and the museum.

import type { GripMode } from '../engine/game-protocol';
import type { Hand } from '../hand/hand';
import type { Orbit } from '../view/orbit';
import type { PlayStore } from './state';

export interface ShortcutActions {
  pause(): void;
  /** Frames the whole tower. */
  frame(): void;
  springs(): void;
  help?(): void;
  menu?(): void;
  hint?(): void;
  xray?(): void;
  mute?(): void;
  /** Returns what a key does for the hand. */
  steer?(key: string): (() => void) | undefined;
  escape?(): void;
  /** Returns true while keys belong to a control. */
  busy(): boolean;
}

const GRIPS: Record<string, GripMode> = { '1': 'auto', '2': 'slide', '3': 'push', '4': 'carry' };
/** Angle of a fine turn of a carried block, rad. */
const FINE = Math.PI / 90;
/** Distance of a step away from the viewer, m. */
const DEPTH = 0.003;

type Bindings = Record<string, () => void>;

export function listenToKeys(store: PlayStore, hand: Hand, orbit: Orbit, actions: ShortcutActions): void {
  const game = gameKeys(hand, actions);
  const carry = carryKeys(hand);
  const camera = cameraKeys(orbit);

  window.addEventListener('keydown', event => {
    store.set({ careful: event.shiftKey });
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Escape') return actions.escape ? actions.escape() : hand.letGo();
    if (actions.busy()) return;
    // Space and Enter on a button press the button.
    if (event.target instanceof HTMLButtonElement && (event.key === ' ' || event.key === 'Enter')) return;
    const action = find(event);
    if (!action) return;
    action();
    event.preventDefault();
  });
  window.addEventListener('keyup', event => store.set({ careful: event.shiftKey }));
  window.addEventListener('blur', () => store.set({ careful: false }));

  function find(event: KeyboardEvent): (() => void) | undefined {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const moving = hand.holds && !store.state.paused;
    if (key in GRIPS) return () => store.set({ grip: GRIPS[key] });
    if (key === ' ') return event.repeat ? () => undefined : actions.pause;
    return actions.steer?.(key) ?? game[key] ?? (moving ? (hand.carries ? carry[key] : undefined) : camera[key]);
  }
}

function gameKeys(hand: Hand, actions: ShortcutActions): Bindings {
  const keys: Bindings = {
    f: actions.frame,
    p: () => hand.place(),
    s: actions.springs,
    q: () => hand.turn(Math.PI / 2),
    e: () => hand.turn(-Math.PI / 2),
    r: () => hand.tip(),
    '[': () => hand.turn(FINE),
    ']': () => hand.turn(-FINE),
  };
  if (actions.xray) keys.x = actions.xray;
  if (actions.mute) keys.m = actions.mute;
  if (actions.hint) keys.n = actions.hint;
  if (actions.menu) keys.g = actions.menu;
  if (actions.help) keys.h = keys['?'] = actions.help;
  return keys;
}

function carryKeys(hand: Hand): Bindings {
  return {
    ArrowLeft: () => hand.turn(FINE),
    ArrowRight: () => hand.turn(-FINE),
    ArrowUp: () => hand.moveAway(DEPTH),
    ArrowDown: () => hand.moveAway(-DEPTH),
  };
}

function cameraKeys(orbit: Orbit): Bindings {
  return {
    ArrowLeft: () => orbit.turn(-0.12, 0),
    ArrowRight: () => orbit.turn(0.12, 0),
    ArrowUp: () => orbit.turn(0, 0.1),
    ArrowDown: () => orbit.turn(0, -0.1),
    '+': () => orbit.zoom(0.88),
    '=': () => orbit.zoom(0.88),
    '-': () => orbit.zoom(1 / 0.88),
    a: () => orbit.turn(-0.12, 0),
    d: () => orbit.turn(0.12, 0),
  };
}
