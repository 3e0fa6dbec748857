// The blocks of a page: sizes, the last two states, and the interpolated state in the picture.
//
// Two maps lead from a block's frame to the world. The pose alone moves the block as a whole, such
// as the point at which a hand holds it; the surface is also strained where the block has soft
// springs inside.

import { Matrix3, Matrix4, Quaternion, Vector3 } from 'three';
import { POSE_STRIDE } from '../engine/game-protocol';
import { STRAIN_STRIDE, strains, unstrained } from './lattice';

/** Half of a long edge, m: converts a change of strain to a displacement. */
const REACH = 0.04;

export class Bodies {
  readonly count: number;
  /** Newest poses. */
  newest: Float32Array;
  private older: Float32Array;
  /** Poses in the picture. */
  readonly shown: Float32Array;
  private readonly none: Float32Array;
  /** Strain of the blocks in each of the three states. */
  private readonly strain: Record<'older' | 'newest' | 'shown', Float32Array>;

  /**
   * `particleOffset`: distance of the particles from the block's centre along each axis, as a
   * fraction of half the edge.
   */
  constructor(
    readonly sizes: Float32Array,
    poses: Float32Array,
    private readonly particleOffset = 1 / Math.sqrt(3),
  ) {
    this.count = sizes.length / 3;
    this.newest = poses;
    this.older = poses;
    this.shown = poses.slice();
    this.none = unstrained(this.count);
    this.strain = { older: this.none, newest: this.none, shown: this.none.slice() };
  }

  /** Takes the next state; without `lattices` the blocks are not strained. */
  arrive(poses: Float32Array, lattices: Float32Array | null = null): void {
    this.older = this.newest;
    this.newest = poses;
    this.strain.older = this.strain.newest;
    this.strain.newest = lattices ? strains(lattices, poses, this.sizes, this.particleOffset) : this.none;
  }

  /**
   * Sets the picture to fraction `t` between the older and the newer state; returns the largest
   * change, m.
   */
  blend(t: number): number {
    const { older, newest, shown } = this;
    let change = 0;
    for (let at = 0; at < shown.length; at += POSE_STRIDE) {
      // Two unit quaternions of one orientation may differ in sign.
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
    return Math.max(change, this.blendStrain(t));
  }

  private blendStrain(t: number): number {
    const { older, newest, shown } = this.strain;
    let change = 0;
    for (let at = 0; at < shown.length; at++) {
      const value = older[at] + t * (newest[at] - older[at]);
      change = Math.max(change, REACH * Math.abs(value - shown[at]));
      shown[at] = value;
    }
    return change;
  }

  size(body: number): Vector3 {
    return new Vector3().fromArray(this.sizes, 3 * body);
  }

  position(body: number, poses = this.shown): Vector3 {
    return new Vector3().fromArray(poses, POSE_STRIDE * body);
  }

  rotation(body: number, poses = this.shown): Quaternion {
    return new Quaternion().fromArray(poses, POSE_STRIDE * body + 3);
  }

  /** Maps a point of the world to the body's frame, by the pose alone. */
  toLocal(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().sub(this.position(body, poses)).applyQuaternion(this.rotation(body, poses).conjugate());
  }

  /** Maps a point of the body's frame to the world, by the pose alone. */
  toWorld(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().applyQuaternion(this.rotation(body, poses)).add(this.position(body, poses));
  }

  /** Maps directions of the unstrained block to the world: strain, then rotation. */
  axes(body: number, poses = this.shown): Matrix3 {
    const rotation = new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromQuaternion(this.rotation(body, poses)));
    const strain = poses === this.shown ? this.strain.shown : this.strain.newest;
    return rotation.multiply(new Matrix3().fromArray(strain, STRAIN_STRIDE * body));
  }

  /** Maps a point of the unstrained block to the world. */
  surface(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().applyMatrix3(this.axes(body, poses)).add(this.position(body, poses));
  }

  /** Maps a unit cube to a box of edge lengths `size` (m) with the block's pose and strain. */
  matrix(body: number, size: Vector3, target = new Matrix4()): Matrix4 {
    const axes = this.axes(body);
    return target.setFromMatrix3(axes).scale(size).setPosition(this.position(body));
  }

  /** Height of the highest point in the newest state, m. */
  top(): number {
    let top = 0;
    for (let body = 0; body < this.count; body++) {
      const half = this.halfExtent(body, new Vector3(0, 0, 1), this.newest);
      top = Math.max(top, this.position(body, this.newest).z + half);
    }
    return top;
  }

  /** Half the extent of a body along a unit direction of the world, m. */
  halfExtent(body: number, direction: Vector3, poses = this.shown): number {
    const { x, y, z } = direction.clone().applyMatrix3(this.axes(body, poses).transpose());
    const size = this.size(body);
    return (Math.abs(x) * size.x + Math.abs(y) * size.y + Math.abs(z) * size.z) / 2;
  }
}
