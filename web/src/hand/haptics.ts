// What the fingers feel: pulses of the phone or of the gamepad by the force of the hand.

import type { PageStore } from '../app/state';
import type { Frame } from '../engine/protocol';

/** Simulated time between two pulses, s. */
const INTERVAL = 0.1;
/** Force over the largest from which it is felt. */
const FELT = 0.2;
/** Longest pulse of a phone, ms; its strength cannot be set. */
const LONGEST = 28;

/** Returns the strength of the pulse for a force over the largest: 0 to 1, never falling. */
export function pulse(force: number): number {
  return Math.min(1, Math.max(0, (force - FELT) / (1 - FELT)));
}

/** Returns true where something can vibrate, as far as a page can know. */
export function canVibrate(): boolean {
  return typeof navigator.vibrate === 'function' && matchMedia('(hover: none)').matches;
}

export class Haptics {
  private next = 0;

  constructor(private readonly store: PageStore) {}

  /** Takes a frame. */
  receive({ update }: Frame): void {
    const { hand, report } = update;
    const { vibration, maxForce, watching } = this.store.state;
    if (report.time < this.next - 2 * INTERVAL) this.next = 0;
    // Fingers feel no hand but that of the player.
    if (!vibration || watching || !hand || hand.grip === 'carry' || report.time < this.next) return;
    const strength = pulse(Math.hypot(...hand.force) / maxForce);
    if (strength === 0) return;
    this.next = report.time + INTERVAL;
    navigator.vibrate?.(Math.max(4, Math.round(LONGEST * strength)));
    const pad = navigator.getGamepads?.().find(found => found?.connected);
    const effect = { duration: 1000 * INTERVAL, weakMagnitude: strength, strongMagnitude: strength * strength };
    void pad?.vibrationActuator?.playEffect('dual-rumble', effect).catch(() => undefined);
  }
}
