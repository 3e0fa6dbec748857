// The camera: orbits a point on the tower's axis, never below the table.

import { MathUtils, PerspectiveCamera, Vector3 } from 'three';

const ELEVATION = { min: MathUtils.degToRad(1), max: MathUtils.degToRad(89) };
/** Smallest height of the centre of the orbit, m. */
const MIN_HEIGHT = 0.01;
/** m. */
const DISTANCE = { min: 0.12, max: 4 };
/**
 * Heights of the controls above and below the tower, px, in pictures up to a width in which there
 * is no room beside it.
 */
const NARROW = { width: 620, above: 120, below: 150 };
/** Heights in pictures up to a height, as of a phone on its side. */
const LOW = { height: 480, above: 0, below: 80 };
/** In other pictures the controls are beside the tower. */
const WIDE = { above: 0, below: 0 };
/** Time constant of the camera, s. */
const TIME_CONSTANT = 0.07;

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
  /**
   * Fraction of the picture's height without controls, and offset of its middle over the height.
   */
  private free = 1;
  private raised = 0;
  /** Size of the picture, px. */
  private width = 1;
  private height = 1;

  /** `calm`: the camera moves at once; `controls`: the page has controls over the picture. */
  constructor(
    private readonly calm: boolean,
    private readonly controls = true,
  ) {
    this.camera.up.set(0, 0, 1);
    this.apply();
  }

  get azimuth(): number {
    return this.now.azimuth;
  }

  get elevation(): number {
    return this.now.elevation;
  }

  /** Fits a picture of `width` x `height` px and keeps the zoom, as when a phone is rotated. */
  resize(width: number, height: number): void {
    const before = this.fit();
    this.width = width;
    this.height = height;
    this.camera.aspect = width / height;
    const beside = !this.controls || (width > NARROW.width && height > LOW.height);
    const { above, below } = beside ? WIDE : width <= NARROW.width ? NARROW : LOW;
    this.free = Math.max(0.4, 1 - (above + below) / height);
    this.raised = Math.min(0.2, (below - above) / 2 / height);
    this.camera.updateProjectionMatrix();
    const after = this.fit();
    this.zoom(after.distance / before.distance);
    this.goal.height = Math.max(MIN_HEIGHT, this.goal.height + (after.height - before.height));
  }

  /** Rotates by a drag, px. */
  drag(dx: number, dy: number): void {
    this.turn(-dx * 0.007, dy * 0.006);
  }

  turn(azimuth: number, elevation: number): void {
    this.goal.azimuth += azimuth;
    this.goal.elevation = MathUtils.clamp(this.goal.elevation + elevation, ELEVATION.min, ELEVATION.max);
  }

  /** Multiplies the distance. */
  zoom(factor: number): void {
    this.goal.distance = MathUtils.clamp(this.goal.distance * factor, DISTANCE.min, DISTANCE.max);
  }

  /** Moves the centre of the orbit up or down by a drag, px. */
  lift(dy: number): void {
    const displacement = (dy / this.height) * this.span(this.goal.distance);
    this.goal.height = MathUtils.clamp(this.goal.height + displacement, MIN_HEIGHT, Math.max(0.2, this.top + 0.1));
  }

  /** Frames the whole tower, whose top is at height `top`, m. */
  frame(top: number, azimuth?: number): void {
    this.top = top;
    this.goal = { azimuth: azimuth ?? this.goal.azimuth, elevation: 0.36, ...this.fit() };
    if (azimuth !== undefined) {
      this.now = { ...this.goal };
      this.apply();
    }
  }

  /** Distance and height from which the whole tower is visible, clear of the controls. */
  private fit(): Pick<View, 'distance' | 'height'> {
    // Room for a new row and for the hand above it, and for the panel beside it.
    const tall = Math.max(this.top + 0.12, (this.top + 0.04) / this.free);
    const wide = 0.26;
    const distance = (Math.max(tall, wide / this.camera.aspect) / this.span(1)) * 1.12 + 0.06;
    return { distance, height: Math.max(MIN_HEIGHT, this.top / 2 + 0.005 - this.raised * this.span(distance)) };
  }

  /** Stops the camera: its motion must not move a held block. */
  halt(): void {
    this.goal = { ...this.now };
  }

  /** Advances by `dt` seconds; returns true if the camera moved. */
  update(dt: number): boolean {
    const part = this.calm ? 1 : 1 - Math.exp(-dt / TIME_CONSTANT);
    let moved = false;
    for (const key of ['azimuth', 'elevation', 'distance', 'height'] as const) {
      const distance = this.goal[key] - this.now[key];
      if (distance === 0) continue;
      moved = true;
      this.now[key] = Math.abs(distance) < 1e-4 ? this.goal[key] : this.now[key] + part * distance;
    }
    if (moved) this.apply();
    return moved;
  }

  /** Screen position of a point, CSS px. */
  project(point: Vector3): { x: number; y: number } {
    const ndc = point.clone().project(this.camera);
    return { x: (0.5 + ndc.x / 2) * this.width, y: (0.5 - ndc.y / 2) * this.height };
  }

  /** Direction from the camera through a point of the screen, CSS px. */
  ray(x: number, y: number): Vector3 {
    return new Vector3((2 * x) / this.width - 1, 1 - (2 * y) / this.height, 0.5)
      .unproject(this.camera)
      .sub(this.camera.position)
      .normalize();
  }

  /** Pixels per metre at the depth of `point`. */
  scaleAt(point: Vector3): number {
    const depth = point.clone().sub(this.camera.position).dot(this.forward());
    return this.height / this.span(Math.max(depth, 0.02));
  }

  /** Height of the picture at a depth, m. */
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
