// The gamepad: a stick chooses and carries blocks, a trigger pulls with the force of the finger.

import type { PlayStore } from '../app/state';
import type { Orbit } from '../view/orbit';
import type { Hand } from './hand';
import { readPad, type ButtonName, type Pad, type PadIntent } from './pad';
import type { Steer, Steering } from './steering';

/** Turn of the camera at a full stick, rad/s. */
const TURN = 1.8;
/** Smallest change of the force that is sent to the hand, over its largest. */
const STEP = 0.04;
/** Weakest pull of a trigger, over the hand's largest force: less moves no block. */
const WEAKEST = 0.05;
const STILL: Steer = { right: 0, up: 0, away: 0 };

export interface PadActions {
  pause(): void;
  /** Frames the whole tower. */
  frame(): void;
  /** Returns true while a dialog covers the game. */
  busy(): boolean;
}

export class Gamepads {
  private before: Pad | null = null;
  /** Motion that is asked of the hand. */
  steer: Steer = STILL;
  /** Part of the largest force that was sent to the hand; 1 without a trigger. */
  private force = 1;

  constructor(
    private readonly store: PlayStore,
    private readonly hand: Hand,
    private readonly steering: Steering,
    private readonly orbit: Orbit,
    private readonly actions: PadActions,
  ) {}

  /** Reads the gamepads; `elapsed`: time since the last call, s. */
  poll(elapsed: number): void {
    const pad = navigator.getGamepads?.().find(found => found?.connected) ?? null;
    if (!pad || this.actions.busy()) {
      this.steer = STILL;
      this.before = null;
      return;
    }
    const now: Pad = { axes: [...pad.axes], buttons: pad.buttons.map(({ pressed, value }) => ({ pressed, value })) };
    const intent = readPad(now, this.before);
    this.before = now;
    for (const name of intent.pressed) this.press(name);
    if (intent.flick && !this.hand.holds) this.steering.choose(intent.flick);
    this.orbit.turn(intent.camera.x * TURN * elapsed, intent.camera.y * TURN * elapsed);
    this.steer = intent.steer;
    this.setForce(intent);
  }

  private press(name: ButtonName): void {
    const { hand, steering, actions } = this;
    const doing: Partial<Record<ButtonName, () => void>> = {
      take: () => this.take(),
      letGo: () => (hand.holds ? hand.letGo() : steering.end()),
      poke: () => steering.poke(),
      setDown: () => hand.place(),
      turnLeft: () => hand.turn(Math.PI / 2),
      turnRight: () => hand.turn(-Math.PI / 2),
      frame: actions.frame,
      pause: actions.pause,
      up: () => steering.choose({ x: 0, y: -1 }),
      down: () => steering.choose({ x: 0, y: 1 }),
      left: () => steering.choose({ x: -1, y: 0 }),
      right: () => steering.choose({ x: 1, y: 0 }),
    };
    doing[name]?.();
  }

  private take(): void {
    const { hand, steering } = this;
    if (!steering.active) return steering.choose({ x: 0, y: 0 });
    if (!hand.holds) return void steering.take();
    if (hand.canPlace()) hand.place();
  }

  /** The finger on the trigger gives the force of the hand, as long as it holds a block. */
  private setForce({ force }: PadIntent): void {
    const wanted = this.steering.holds && !this.hand.carries && force !== null ? Math.max(WEAKEST, force) : 1;
    if (Math.abs(wanted - this.force) < STEP && (wanted !== 1 || this.force === 1)) return;
    this.force = wanted;
    this.hand.limitForce(wanted * this.store.state.maxForce);
  }
}
