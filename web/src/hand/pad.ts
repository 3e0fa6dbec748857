// A gamepad of the standard layout as plain data.

import type { Steer } from './steering';

/** Displacement of a stick below which it rests. */
const REST = 0.18;

/** Buttons of the standard layout by what they do. */
export const BUTTON = {
  take: 0,
  letGo: 1,
  poke: 2,
  setDown: 3,
  turnLeft: 4,
  turnRight: 5,
  push: 6,
  pull: 7,
  frame: 8,
  pause: 9,
  up: 12,
  down: 13,
  left: 14,
  right: 15,
} as const;

export type ButtonName = keyof typeof BUTTON;

/** State of a gamepad. */
export interface Pad {
  axes: readonly number[];
  buttons: readonly { pressed: boolean; value: number }[];
}

/** Intent of a player. */
export interface PadIntent {
  /** Buttons that went down. */
  pressed: ButtonName[];
  steer: Steer;
  /** Turn of the camera, -1 to 1: to the right, and up. */
  camera: { x: number; y: number };
  /** Direction of the left stick when it leaves its rest, y down; null otherwise. */
  flick: { x: number; y: number } | null;
  /** Part of the hand's largest force that a trigger asks for; null without one. */
  force: number | null;
}

/** Returns what changed from one state of a gamepad to the next, and what goes on. */
export function readPad(now: Pad, before: Pad | null): PadIntent {
  const down = (pad: Pad | null, name: ButtonName) => pad?.buttons[BUTTON[name]]?.pressed ?? false;
  const trigger = (name: ButtonName) => now.buttons[BUTTON[name]]?.value ?? 0;
  const [left, right] = [stick(now, 0), stick(now, 2)];
  const [pull, push] = [trigger('pull'), trigger('push')];
  const wasAtRest = !before || Math.hypot(stick(before, 0).x, stick(before, 0).y) === 0;
  return {
    pressed: (Object.keys(BUTTON) as ButtonName[]).filter(name => down(now, name) && !down(before, name)),
    steer: { right: left.x, up: -left.y, away: push - pull },
    camera: { x: right.x, y: -right.y },
    flick: wasAtRest && Math.hypot(left.x, left.y) > 0 ? left : null,
    force: Math.max(pull, push) > 0.05 ? Math.max(pull, push) : null,
  };
}

/** Displacement of a stick, 0 at rest and continuous from there. */
function stick({ axes }: Pad, first: number): { x: number; y: number } {
  const [x, y] = [axes[first] ?? 0, axes[first + 1] ?? 0];
  const length = Math.hypot(x, y);
  if (length <= REST) return { x: 0, y: 0 };
  const scale = (Math.min(1, length) - REST) / ((1 - REST) * length);
  return { x: x * scale, y: y * scale };
}
