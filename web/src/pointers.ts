// Who gets a pointer: the hand, where it comes down on a block, or the camera. One never moves while the other is at work, except that
// frozen time gives every pointer to the camera.

import { pick, type Hit } from './boxes';
import type { Bodies } from './bodies';
import type { Hand } from './hand';
import type { Orbit } from './orbit';

/** Way, px, and time, ms, up to which a press is a tap. */
const TAP = { way: 6, time: 350 };
/** Time between two taps of a double tap, ms. */
const DOUBLE = 320;
/** Depth per wheel step of a carried block, m/px. */
const WHEEL_DEPTH = 0.00025;

type Role = 'hand' | 'camera' | 'second';

interface Pointer {
  role: Role;
  x: number;
  y: number;
  way: number;
  began: number;
}

export class Pointers {
  /** The block under a mouse that rests. */
  hovered: number | null = null;
  private readonly pointers = new Map<number, Pointer>();
  private lastTap = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly hand: Hand,
    private readonly orbit: Orbit,
    private readonly bodies: () => Bodies | null,
    private readonly frame: () => void,
  ) {
    canvas.addEventListener('pointerdown', event => this.down(event));
    canvas.addEventListener('pointermove', event => this.move(event));
    canvas.addEventListener('pointerup', event => this.up(event));
    canvas.addEventListener('pointercancel', event => this.lost(event));
    canvas.addEventListener('lostpointercapture', event => this.lost(event));
    canvas.addEventListener('pointerleave', () => (this.hovered = null));
    canvas.addEventListener('wheel', event => this.wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('dragstart', event => event.preventDefault());
  }

  /** Whether any pointer is down: no hint for the mouse is due then. */
  get active(): boolean {
    return this.pointers.size > 0;
  }

  pickAt(x: number, y: number): Hit | null {
    const bodies = this.bodies();
    if (!bodies) return null;
    const { width, height } = this.canvas.getBoundingClientRect();
    return pick(bodies, this.orbit.camera.position, this.orbit.ray(x, y, width, height));
  }

  private down(event: PointerEvent): void {
    event.preventDefault();
    // Keys belong to the game again, without a focus ring around all of it.
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    this.canvas.setPointerCapture(event.pointerId);
    this.hovered = null;
    this.pointers.set(event.pointerId, {
      role: this.roleOf(event),
      x: event.offsetX,
      y: event.offsetY,
      way: 0,
      began: event.timeStamp,
    });
    this.dress();
  }

  private roleOf(event: PointerEvent): Role {
    if (this.hand.frozen) return 'camera';
    if (this.hand.hold) return this.with('hand') ? 'second' : 'hand';
    if (this.with('camera') || event.button !== 0) return 'camera';
    const hit = this.pickAt(event.offsetX, event.offsetY);
    if (!hit) return 'camera';
    this.hand.press(hit);
    return 'hand';
  }

  private move(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) {
      if (event.pointerType === 'mouse') this.hovered = this.pickAt(event.offsetX, event.offsetY)?.body ?? null;
      this.dress();
      return;
    }
    const dx = event.offsetX - pointer.x;
    const dy = event.offsetY - pointer.y;
    const before = this.spread();
    pointer.x = event.offsetX;
    pointer.y = event.offsetY;
    pointer.way += Math.hypot(dx, dy);
    if (this.hand.frozen) this.turnCamera(event, dx, dy, before);
    else if (pointer.role === 'hand') this.hand.drag(dx, dy);
    else if (pointer.role === 'second') this.hand.depth((-dy / this.canvas.clientHeight) * 0.5);
    else if (!this.hand.hold) this.turnCamera(event, dx, dy, before);
  }

  private turnCamera(event: PointerEvent, dx: number, dy: number, before: number): void {
    if (this.pointers.size === 2) {
      const after = this.spread();
      if (before > 0 && after > 0) this.orbit.zoom(before / after);
      this.orbit.drag(dx / 2, 0);
      this.orbit.lift(dy / 2, this.canvas.clientHeight);
    } else if (event.shiftKey || (event.buttons & 4) !== 0) {
      this.orbit.drag(dx, 0);
      this.orbit.lift(dy, this.canvas.clientHeight);
    } else {
      this.orbit.drag(dx, dy);
    }
  }

  private up(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return;
    this.pointers.delete(event.pointerId);
    const tap = pointer.way < TAP.way && event.timeStamp - pointer.began < TAP.time;
    if (pointer.role === 'hand') this.hand.release(tap);
    if (pointer.role === 'camera' && tap) this.tapped(event.timeStamp);
    this.dress();
  }

  /** The browser took the pointer away: what it held is let go, unless time stands still. */
  private lost(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return;
    this.pointers.delete(event.pointerId);
    if (pointer.role === 'hand' && !this.hand.frozen && !this.hand.hold?.placing) this.hand.letGo();
    this.dress();
  }

  private tapped(now: number): void {
    if (!this.hand.hold) this.hand.selected = null;
    if (now - this.lastTap < DOUBLE) {
      this.frame();
      this.lastTap = 0;
    } else {
      this.lastTap = now;
    }
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    const way = Math.max(-240, Math.min(240, event.deltaY * unit));
    if (this.hand.hold && !this.hand.frozen) this.hand.depth(-way * WHEEL_DEPTH);
    // A pinch on a touchpad comes as a wheel with the control key, in small steps.
    else this.orbit.zoom(Math.exp(way * (event.ctrlKey ? 0.01 : 0.0012)));
  }

  private with(role: Role): boolean {
    return [...this.pointers.values()].some(p => p.role === role);
  }

  /** Distance between two fingers; 0 unless there are two. */
  private spread(): number {
    if (this.pointers.size !== 2) return 0;
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  private dress(): void {
    const { classList } = this.canvas;
    classList.toggle('over', this.hovered !== null);
    classList.toggle('holding', this.with('hand'));
    classList.toggle('turning', this.with('camera'));
  }
}
