// Pointers and keys that move the camera of a widget. A tap chooses a block, two frame the tower.

import type { Picture } from './picture';

/** Distance, px, up to which a press is a tap. */
const TAP = 6;
/** Angle of a key, rad, and factor of the distance. */
const KEY = { angle: 0.12, zoom: 1.1 };
/** Factor of the distance per wheel step, 1/px. */
const WHEEL = 0.0015;

const KEYS: Readonly<Record<string, (picture: Picture) => void>> = {
  ArrowLeft: ({ orbit }) => orbit.turn(KEY.angle, 0),
  ArrowRight: ({ orbit }) => orbit.turn(-KEY.angle, 0),
  ArrowUp: ({ orbit }) => orbit.turn(0, KEY.angle),
  ArrowDown: ({ orbit }) => orbit.turn(0, -KEY.angle),
  '+': ({ orbit }) => orbit.zoom(1 / KEY.zoom),
  '-': ({ orbit }) => orbit.zoom(KEY.zoom),
  f: picture => picture.frame(),
};

export class Camera {
  private readonly pointers = new Map<number, { x: number; y: number; distance: number }>();

  /** `tap` takes the block that was tapped, null beside all. */
  constructor(
    private readonly picture: Picture,
    private readonly tap: (body: number | null) => void,
  ) {
    const { canvas } = picture;
    canvas.addEventListener('pointerdown', event => this.down(event));
    canvas.addEventListener('pointermove', event => this.move(event));
    canvas.addEventListener('pointerup', event => this.up(event));
    canvas.addEventListener('pointercancel', event => this.pointers.delete(event.pointerId));
    canvas.addEventListener('dblclick', () => picture.frame());
    canvas.addEventListener('wheel', event => this.wheel(event), { passive: false });
    canvas.addEventListener('keydown', event => this.key(event));
  }

  private down(event: PointerEvent): void {
    this.picture.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY, distance: 0 });
  }

  private move(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return;
    const { orbit } = this.picture;
    const by = { x: event.offsetX - pointer.x, y: event.offsetY - pointer.y };
    const before = this.spread();
    pointer.x = event.offsetX;
    pointer.y = event.offsetY;
    pointer.distance += Math.hypot(by.x, by.y);
    if (this.pointers.size === 2) {
      const after = this.spread();
      if (before > 0 && after > 0) orbit.zoom(before / after);
      orbit.lift(by.y / 2);
    } else if (event.shiftKey) orbit.lift(by.y);
    else orbit.drag(by.x, by.y);
    this.picture.request();
  }

  private up(event: PointerEvent): void {
    const pointer = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    if (pointer && pointer.distance <= TAP) this.tap(this.picture.blockAt(event.offsetX, event.offsetY));
  }

  /** The wheel scrolls the notebook; with Ctrl, or a pinch of a touchpad, it zooms. */
  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    this.picture.orbit.zoom(Math.exp(event.deltaY * WHEEL));
    this.picture.request();
  }

  private key(event: KeyboardEvent): void {
    const action = event.ctrlKey || event.altKey || event.metaKey ? undefined : KEYS[event.key];
    if (!action) return;
    event.preventDefault();
    action(this.picture);
    this.picture.request();
  }

  /** Distance between two pointers, px. */
  private spread(): number {
    const [a, b] = [...this.pointers.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  }
}
