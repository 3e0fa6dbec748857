// Assigns each pointer to the hand, where it comes down on a block, or to the camera. One never
// moves while the other is in use, except that every pointer moves the camera while the game is
// paused.

import type { PlayStore } from '../app/state';
import type { Bodies } from '../view/bodies';
import type { Orbit } from '../view/orbit';
import { pick, type Hit } from '../view/picking';
import type { Hand } from './hand';

/** Distance, px, and time, ms, up to which a press is a tap. */
const TAP = { distance: 6, time: 350 };
/** Time between the two taps of a double tap, ms. */
const DOUBLE_TAP = 320;
/** Depth per wheel step of a carried block, m/px. */
const WHEEL_DEPTH = 0.00025;
/** Depth per height of the picture of a second finger, m. */
const FINGER_DEPTH = 0.5;

type Role = 'hand' | 'camera' | 'second';

interface Pointer {
  role: Role;
  x: number;
  y: number;
  distance: number;
  began: number;
}

export class Pointers {
  private readonly pointers = new Map<number, Pointer>();
  private lastTap = 0;

  /** `frame` shows the whole tower. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly store: PlayStore,
    private readonly hand: Hand,
    private readonly orbit: Orbit,
    private readonly scene: { bodies(): Bodies | null; frame(): void },
  ) {
    canvas.addEventListener('pointerdown', event => this.down(event));
    canvas.addEventListener('pointermove', event => this.move(event));
    canvas.addEventListener('pointerup', event => this.up(event));
    canvas.addEventListener('pointercancel', event => this.cancel(event));
    canvas.addEventListener('lostpointercapture', event => this.cancel(event));
    canvas.addEventListener('pointerleave', () => store.set({ hovered: null }));
    canvas.addEventListener('wheel', event => this.wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('dragstart', event => event.preventDefault());
    store.subscribe(['hovered', 'pointing'], () => this.showCursor());
  }

  /** Returns the block at a position of the canvas, px. */
  pickAt(x: number, y: number): Hit | null {
    const bodies = this.scene.bodies();
    return bodies && pick(bodies, this.orbit.camera.position, this.orbit.ray(x, y));
  }

  private down(event: PointerEvent): void {
    event.preventDefault();
    // Keys belong to the game again, without a focus ring around all of it.
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, {
      role: this.roleOf(event),
      x: event.offsetX,
      y: event.offsetY,
      distance: 0,
      began: event.timeStamp,
    });
    this.store.set({ hovered: null, pointing: true });
    this.showCursor();
  }

  private roleOf(event: PointerEvent): Role {
    if (this.store.state.paused || this.store.state.watching) return 'camera';
    if (this.hand.holds) return this.has('hand') ? 'second' : 'hand';
    if (this.has('camera') || event.button !== 0) return 'camera';
    const hit = this.pickAt(event.offsetX, event.offsetY);
    if (!hit) return 'camera';
    this.hand.press(hit);
    return 'hand';
  }

  private move(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) {
      if (event.pointerType === 'mouse')
        this.store.set({ hovered: this.pickAt(event.offsetX, event.offsetY)?.body ?? null });
      return;
    }
    const by = { x: event.offsetX - pointer.x, y: event.offsetY - pointer.y };
    const spread = this.spread();
    pointer.x = event.offsetX;
    pointer.y = event.offsetY;
    pointer.distance += Math.hypot(by.x, by.y);
    if (this.store.state.paused) this.turnCamera(event, by, spread);
    else if (pointer.role === 'hand') this.hand.drag(by);
    else if (pointer.role === 'second') this.hand.moveAway((-by.y / this.canvas.clientHeight) * FINGER_DEPTH);
    else if (!this.hand.holds) this.turnCamera(event, by, spread);
  }

  private turnCamera(event: PointerEvent, by: { x: number; y: number }, before: number): void {
    if (this.pointers.size === 2) {
      const after = this.spread();
      if (before > 0 && after > 0) this.orbit.zoom(before / after);
      this.orbit.drag(by.x / 2, 0);
      this.orbit.lift(by.y / 2);
    } else if (event.shiftKey || (event.buttons & 4) !== 0) {
      this.orbit.drag(by.x, 0);
      this.orbit.lift(by.y);
    } else {
      this.orbit.drag(by.x, by.y);
    }
  }

  private up(event: PointerEvent): void {
    const pointer = this.remove(event);
    if (!pointer) return;
    const tap = pointer.distance < TAP.distance && event.timeStamp - pointer.began < TAP.time;
    if (pointer.role === 'hand') this.hand.release(tap);
    if (pointer.role === 'camera' && tap) this.tapped(event.timeStamp);
  }

  /** The browser took the pointer away: its block is released, except while the game is paused. */
  private cancel(event: PointerEvent): void {
    const pointer = this.remove(event);
    if (pointer?.role === 'hand' && !this.store.state.paused && this.hand.gesture !== 'placing') this.hand.letGo();
  }

  private remove(event: PointerEvent): Pointer | undefined {
    const pointer = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    this.store.set({ pointing: this.pointers.size > 0 });
    this.showCursor();
    return pointer;
  }

  private tapped(now: number): void {
    if (!this.hand.holds) this.store.set({ selected: null });
    if (now - this.lastTap < DOUBLE_TAP) {
      this.scene.frame();
      this.lastTap = 0;
    } else {
      this.lastTap = now;
    }
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    const distance = Math.max(-240, Math.min(240, event.deltaY * unit));
    if (this.hand.holds && !this.store.state.paused) this.hand.moveAway(-distance * WHEEL_DEPTH);
    // A pinch on a touchpad comes as a wheel with the control key, in small steps.
    else this.orbit.zoom(Math.exp(distance * (event.ctrlKey ? 0.01 : 0.0012)));
  }

  private has(role: Role): boolean {
    return [...this.pointers.values()].some(p => p.role === role);
  }

  /** Distance between two fingers, px; 0 unless there are two. */
  private spread(): number {
    if (this.pointers.size !== 2) return 0;
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  private showCursor(): void {
    const { classList } = this.canvas;
    classList.toggle('over', this.store.state.hovered !== null);
    classList.toggle('holding', this.has('hand'));
    classList.toggle('turning', this.has('camera'));
  }
}
