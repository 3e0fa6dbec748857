// The hand of 2003 (sections 4.8 and 5.6): it drags a block in the plane of the screen or in depth,
// by requests to the simulator. Nothing limits, levels or attracts it.

import type { Vector3 } from 'three';
import type { Vec } from '../engine/game-protocol';
import type { Orbit } from '../view/orbit';
import type { Pointer2003, Request2003 } from './protocol';

export interface RequestSink {
  request(request: Request2003): void;
}

export class Hand2003 {
  /** Block in the hand by the view's own pick; the simulator picks by its ray. */
  body: number | null = null;

  constructor(
    private readonly sink: RequestSink,
    private readonly orbit: Orbit,
  ) {}

  get holds(): boolean {
    return this.body !== null;
  }

  /** Picks the block at a position of the picture, px. */
  pick(body: number, x: number, y: number): void {
    this.body = body;
    // A camera that still turns would move the block.
    this.orbit.halt();
    this.sink.request({ request: 'pick', pointer: this.pointer(x, y) });
  }

  /** Drags in the plane of the screen to a position, px. */
  drag(x: number, y: number): void {
    if (this.holds) this.sink.request({ request: 'drag', pointer: this.pointer(x, y) });
  }

  /** Pulls the block with its centre (m) towards the viewer by pixels at its depth. */
  pull(pixels: number, centre: Vector3): void {
    if (!this.holds) return;
    const distance = pixels / this.orbit.scaleAt(centre);
    this.sink.request({ request: 'pull', distance, toward_viewer: this.towardViewer() });
  }

  /** Goes on in the plane of the screen from where the block is, with the pointer at x, y. */
  resume(x: number, y: number): void {
    if (!this.holds) return;
    this.orbit.halt();
    this.sink.request({ request: 'resume', pointer: this.pointer(x, y) });
  }

  release(): void {
    if (this.holds) this.sink.request({ request: 'release' });
    this.body = null;
  }

  /** Clears the block of a world that has ended. */
  reset(): void {
    this.body = null;
  }

  private pointer(x: number, y: number): Pointer2003 {
    return {
      origin: this.orbit.camera.position.toArray() as Vec,
      direction: this.orbit.ray(x, y).toArray() as Vec,
      toward_viewer: this.towardViewer(),
    };
  }

  private towardViewer(): Vec {
    return this.orbit.forward().negate().toArray() as Vec;
  }
}
