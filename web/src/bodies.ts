// The blocks as the page knows them: sizes, the last two states, and the state in the picture between them.

import { Quaternion, Vector3 } from 'three';
import { POSE_STRIDE } from './protocol';

export class Bodies {
  readonly count: number;
  /** The newest state. */
  newest: Float32Array;
  private older: Float32Array;
  /** The state in the picture. */
  readonly shown: Float32Array;

  constructor(
    readonly sizes: Float32Array,
    poses: Float32Array,
  ) {
    this.count = sizes.length / 3;
    this.newest = poses;
    this.older = poses;
    this.shown = poses.slice();
  }

  arrive(poses: Float32Array): void {
    this.older = this.newest;
    this.newest = poses;
  }

  /** Sets the picture to the place `t` between the older and the newer state, and says by how much it changed (m, or the part of a turn). */
  blend(t: number): number {
    const { older, newest, shown } = this;
    let change = 0;
    for (let at = 0; at < shown.length; at += POSE_STRIDE) {
      // Two unit quaternions of one turn may differ in sign.
      let dot = 0;
      for (let k = 3; k < 7; k++) dot += older[at + k] * newest[at + k];
      const sign = dot < 0 ? -1 : 1;
      let norm = 0;
      for (let k = 0; k < 7; k++) {
        const from = older[at + k] * (k < 3 ? 1 : sign);
        const value = from + t * (newest[at + k] - from);
        change = Math.max(change, Math.abs(value - shown[at + k]));
        shown[at + k] = value;
        if (k >= 3) norm += value * value;
      }
      const scale = 1 / Math.sqrt(norm);
      for (let k = 3; k < 7; k++) shown[at + k] *= scale;
    }
    return change;
  }

  size(body: number): Vector3 {
    return new Vector3().fromArray(this.sizes, 3 * body);
  }

  position(body: number, poses = this.shown): Vector3 {
    return new Vector3().fromArray(poses, POSE_STRIDE * body);
  }

  turn(body: number, poses = this.shown): Quaternion {
    return new Quaternion().fromArray(poses, POSE_STRIDE * body + 3);
  }

  /** A point of the world in the body's frame. */
  toLocal(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().sub(this.position(body, poses)).applyQuaternion(this.turn(body, poses).conjugate());
  }

  /** A point of the body's frame in the world. */
  toWorld(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().applyQuaternion(this.turn(body, poses)).add(this.position(body, poses));
  }

  /** Height of the highest point, m. */
  top(): number {
    let top = 0;
    for (let body = 0; body < this.count; body++) top = Math.max(top, this.position(body).z + this.halfExtent(body, new Vector3(0, 0, 1)));
    return top;
  }

  /** Half of the extent of a body along a unit direction of the world, m. */
  halfExtent(body: number, direction: Vector3, poses = this.shown): number {
    const local = direction.clone().applyQuaternion(this.turn(body, poses).conjugate());
    const size = this.size(body);
    return (Math.abs(local.x) * size.x + Math.abs(local.y) * size.y + Math.abs(local.z) * size.z) / 2;
  }
}
