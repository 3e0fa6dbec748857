// The camera: turns about a point on the tower's axis, to every side and from above, never below the table.

import { MathUtils, PerspectiveCamera, Vector3 } from 'three';

const LOWEST = MathUtils.degToRad(1);
const HIGHEST = MathUtils.degToRad(89);
/** Least height of the point that is looked at, m. */
const LOWEST_TARGET = 0.01;
const NEAREST = 0.12;
const FARTHEST = 4;
/** Heights (px) that controls take above and below the tower, in pictures at most so wide, in which none is beside it. */
const NARROW = { width: 620, above: 120, below: 150 };
/** The same in pictures at most so high, of a phone on its side. */
const LOW = { height: 480, above: 0, below: 80 };
/** In others they stay clear of it. */
const WIDE = { above: 0, below: 0 };
/** Time in which the camera makes up most of its lag, s. */
const EASE = 0.07;

interface View {
  azimuth: number;
  elevation: number;
  distance: number;
  height: number;
}

export class Orbit {
  readonly camera = new PerspectiveCamera(34, 1, 0.02, 20);
  private goal: View = { azimuth: -0.9, elevation: 0.35, distance: 1, height: 0.15 };
  private now: View = { ...this.goal };
  private top = 0.33;
  /** Part of the picture's height that no control takes, and how far its middle is above that of the picture, over the height. */
  private free = 1;
  private raised = 0;

  constructor(private readonly calm: boolean) {
    this.camera.up.set(0, 0, 1);
    this.apply();
  }

  get azimuth(): number {
    return this.now.azimuth;
  }

  get elevation(): number {
    return this.now.elevation;
  }

  /** Fits a picture of `width` x `height` px. What is looked at stays as near as it was for the picture before, as when a phone is turned. */
  resize(width: number, height: number): void {
    const before = this.fit();
    this.camera.aspect = width / height;
    const { above, below } = width <= NARROW.width ? NARROW : height <= LOW.height ? LOW : WIDE;
    this.free = Math.max(0.4, 1 - (above + below) / height);
    this.raised = Math.min(0.2, (below - above) / 2 / height);
    this.camera.updateProjectionMatrix();
    const after = this.fit();
    this.zoom(after.distance / before.distance);
    this.goal.height = Math.max(LOWEST_TARGET, this.goal.height + (after.height - before.height));
  }

  /** Turns by a drag, px. */
  drag(dx: number, dy: number): void {
    this.turn(-dx * 0.007, dy * 0.006);
  }

  turn(azimuth: number, elevation: number): void {
    this.goal.azimuth += azimuth;
    this.goal.elevation = MathUtils.clamp(this.goal.elevation + elevation, LOWEST, HIGHEST);
  }

  /** Multiplies the distance. */
  zoom(factor: number): void {
    this.goal.distance = MathUtils.clamp(this.goal.distance * factor, NEAREST, FARTHEST);
  }

  /** Moves the point that is looked at up or down by a drag, px of a picture `viewport` px high. */
  lift(dy: number, viewport: number): void {
    const way = (dy / viewport) * this.span(this.goal.distance);
    this.goal.height = MathUtils.clamp(this.goal.height + way, LOWEST_TARGET, Math.max(0.2, this.top + 0.1));
  }

  /** Looks at the whole of a tower of height `top`, m. */
  frame(top: number, azimuth?: number): void {
    this.top = top;
    this.goal = { azimuth: azimuth ?? this.goal.azimuth, elevation: 0.36, ...this.fit() };
    if (azimuth !== undefined) {
      this.now = { ...this.goal };
      this.apply();
    }
  }

  /** From where the whole tower is seen, clear of the controls. */
  private fit(): Pick<View, 'distance' | 'height'> {
    // Room for a new row and for the hand above it, and for the panel beside it.
    const tall = Math.max(this.top + 0.12, (this.top + 0.04) / this.free);
    const wide = 0.26;
    const distance = (Math.max(tall, wide / this.camera.aspect) / this.span(1)) * 1.12 + 0.06;
    return { distance, height: Math.max(LOWEST_TARGET, this.top / 2 + 0.005 - this.raised * this.span(distance)) };
  }

  /** Stands still where it is: a held block must not be led by the camera. */
  halt(): void {
    this.goal = { ...this.now };
  }

  /** Moves on by `dt` seconds; whether the picture changes. */
  update(dt: number): boolean {
    const part = this.calm ? 1 : 1 - Math.exp(-dt / EASE);
    let moved = false;
    for (const key of ['azimuth', 'elevation', 'distance', 'height'] as const) {
      const way = this.goal[key] - this.now[key];
      if (way === 0) continue;
      moved = true;
      this.now[key] = Math.abs(way) < 1e-4 ? this.goal[key] : this.now[key] + part * way;
    }
    if (moved) this.apply();
    return moved;
  }

  /** Screen position (CSS px) of a point in a picture of `width` x `height`. */
  project(point: Vector3, width: number, height: number): { x: number; y: number } {
    const ndc = point.clone().project(this.camera);
    return { x: (0.5 + ndc.x / 2) * width, y: (0.5 - ndc.y / 2) * height };
  }

  /** Direction from the camera through a point of the screen. */
  ray(x: number, y: number, width: number, height: number): Vector3 {
    return new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5)
      .unproject(this.camera)
      .sub(this.camera.position)
      .normalize();
  }

  /** Pixels per metre at the depth of `point`, in a picture `height` px high. */
  scaleAt(point: Vector3, height: number): number {
    const depth = point.clone().sub(this.camera.position).dot(this.forward());
    return height / this.span(Math.max(depth, 0.02));
  }

  /** What a picture shows from top to bottom at a depth, m. */
  private span(depth: number): number {
    return 2 * depth * Math.tan(MathUtils.degToRad(this.camera.fov / 2));
  }

  forward(): Vector3 {
    return this.camera.getWorldDirection(new Vector3());
  }

  private apply(): void {
    const { azimuth, elevation, distance, height } = this.now;
    const flat = distance * Math.cos(elevation);
    this.camera.position.set(
      flat * Math.cos(azimuth),
      flat * Math.sin(azimuth),
      Math.max(0.012, height + distance * Math.sin(elevation)),
    );
    this.camera.lookAt(0, 0, height);
    this.camera.updateMatrixWorld();
  }
}
