// Pointers of the hand of 2003: the left button drags a block in the plane of the screen, the right
// one pulls it in depth; on touch a second finger does. Pointers that come down beside the blocks,
// or during a pause, are left to the camera.

import type { Vector3 } from 'three';
import type { Orbit } from '../view/orbit';
import type { Hand2003 } from './hand-2003';

const RIGHT_BUTTON = { down: 2, held: 2 };

export interface HandScene {
  /** True while this hand is chosen. */
  active(): boolean;
  paused(): boolean;
  /** Block at a position of the picture, px. */
  blockAt(x: number, y: number): number | null;
  /** Centre of a block, m. */
  centre(body: number): Vector3;
  /** A pointer came down on a block. */
  picked(body: number): void;
}

export class Pointers2003 {
  private readonly down = new Map<number, { x: number; y: number }>();
  private last = { x: 0, y: 0 };
  /** True while the block is pulled in depth. */
  private pulls = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly hand: Hand2003,
    private readonly orbit: Orbit,
    private readonly scene: HandScene,
  ) {
    const listen = (type: string, listener: (event: PointerEvent) => boolean) => {
      // Ahead of the pointers of the game, which get what this hand does not take.
      const capture = (event: Event) => {
        if (event.target === canvas && listener(event as PointerEvent)) event.stopPropagation();
      };
      canvas.parentElement!.addEventListener(type, capture, { capture: true });
    };
    listen('pointerdown', event => this.press(event));
    listen('pointermove', event => this.move(event));
    listen('pointerup', event => this.lift(event));
    listen('pointercancel', event => this.lift(event));
    listen('lostpointercapture', event => this.lift(event));
  }

  /** Goes on after a pause, in which the camera may have turned. */
  resume(): void {
    this.pulls = false;
    this.hand.resume(this.last.x, this.last.y);
  }

  private press(event: PointerEvent): boolean {
    const { offsetX: x, offsetY: y, button } = event;
    if (!this.scene.active() || this.scene.paused()) return false;
    const body = this.hand.holds ? this.hand.body : this.scene.blockAt(x, y);
    if (body === null || (button !== 0 && button !== RIGHT_BUTTON.down)) return false;
    event.preventDefault();
    this.canvas.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, { x, y });
    this.last = { x, y };
    this.pulls = button === RIGHT_BUTTON.down || this.down.size > 1;
    // After a pause the hand still holds its block, and any press goes on with it.
    if (!this.hand.holds) this.hand.pick(body, x, y);
    else if (this.down.size === 1) this.hand.resume(x, y);
    this.scene.picked(body);
    return true;
  }

  private move(event: PointerEvent): boolean {
    const before = this.down.get(event.pointerId);
    if (!before) return false;
    const { offsetX: x, offsetY: y } = event;
    const by = { x: x - before.x, y: y - before.y };
    this.down.set(event.pointerId, { x, y });
    this.last = { x, y };
    if (this.scene.paused()) {
      this.orbit.drag(by.x, by.y);
      return true;
    }
    const pulls = this.down.size > 1 || (event.buttons & RIGHT_BUTTON.held) !== 0;
    if (pulls) this.pull(by.y / this.down.size);
    else if (this.pulls) this.hand.resume(x, y);
    else this.hand.drag(x, y);
    this.pulls = pulls;
    return true;
  }

  /** Pulls by pixels downwards, each of several fingers by its part. */
  private pull(pixels: number): void {
    if (this.hand.body !== null) this.hand.pull(pixels, this.scene.centre(this.hand.body));
  }

  private lift(event: PointerEvent): boolean {
    if (!this.down.delete(event.pointerId)) return false;
    // A block stays in the hand while the camera turns (section 6.2.1).
    if (this.scene.paused()) return true;
    const [finger] = this.down.values();
    if (finger) this.hand.resume(finger.x, finger.y);
    else this.hand.release();
    this.pulls = false;
    return true;
  }
}
