// The blocks as the page knows them: sizes, the last two states, and the state in the picture between them.
//
// Two maps lead from a block's frame to the world. The pose alone carries what belongs to the block as a whole, such as the point at which
// a hand holds it; the surface is strained besides, where the block has soft springs inside.

import { Matrix3, Matrix4, Quaternion, Vector3 } from 'three';
import { STRAIN_STRIDE, strains, unstrained } from './lattice';
import { POSE_STRIDE } from './protocol';

/** Half of a long edge, m: what a change of strain is counted with. */
const REACH = 0.04;

export class Bodies {
  readonly count: number;
  /** The newest state. */
  newest: Float32Array;
  private older: Float32Array;
  /** The state in the picture. */
  readonly shown: Float32Array;
  private readonly none: Float32Array;
  /** How the blocks are strained in each of the three states. */
  private readonly strain: Record<'older' | 'newest' | 'shown', Float32Array>;

  /** `place`: distance of the particles inside blocks from the centre, over half the edge. */
  constructor(
    readonly sizes: Float32Array,
    poses: Float32Array,
    private readonly place = 1 / Math.sqrt(3),
  ) {
    this.count = sizes.length / 3;
    this.newest = poses;
    this.older = poses;
    this.shown = poses.slice();
    this.none = unstrained(this.count);
    this.strain = { older: this.none, newest: this.none, shown: this.none.slice() };
  }

  /** `lattices`: the particles, where they are told; blocks are else as they were made. */
  arrive(poses: Float32Array, lattices: Float32Array | null = null): void {
    this.older = this.newest;
    this.newest = poses;
    this.strain.older = this.strain.newest;
    this.strain.newest = lattices ? strains(lattices, poses, this.sizes, this.place) : this.none;
  }

  /** Whether the newest state tells of strain. */
  get strained(): boolean {
    return this.strain.newest !== this.none;
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

  turn(body: number, poses = this.shown): Quaternion {
    return new Quaternion().fromArray(poses, POSE_STRIDE * body + 3);
  }

  /** A point of the world in the body's frame, of the pose alone. */
  toLocal(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().sub(this.position(body, poses)).applyQuaternion(this.turn(body, poses).conjugate());
  }

  /** A point of the body's frame in the world, by the pose alone. */
  toWorld(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().applyQuaternion(this.turn(body, poses)).add(this.position(body, poses));
  }

  /** The map of directions from the block as it was made to the world, strain and turn. */
  axes(body: number, poses = this.shown): Matrix3 {
    const turn = new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromQuaternion(this.turn(body, poses)));
    const strain = poses === this.shown ? this.strain.shown : this.strain.newest;
    return turn.multiply(new Matrix3().fromArray(strain, STRAIN_STRIDE * body));
  }

  /** A point of the block as it was made in the world, where strain has moved it. */
  surface(body: number, point: Vector3, poses = this.shown): Vector3 {
    return point.clone().applyMatrix3(this.axes(body, poses)).add(this.position(body, poses));
  }

  /** The map that makes a unit cube a box of edge lengths `size` with the block's place, turn and strain. */
  matrix(body: number, size: Vector3, target = new Matrix4()): Matrix4 {
    const axes = this.axes(body);
    const at = this.position(body);
    return target.setFromMatrix3(axes).scale(size).setPosition(at);
  }

  /** Edge lengths as strained, m. */
  edges(body: number, poses = this.shown): Vector3 {
    const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
    this.axes(body, poses).extractBasis(x, y, z);
    return this.size(body).multiply(new Vector3(x.length(), y.length(), z.length()));
  }

  /** Height of the highest point, m. */
  top(): number {
    let top = 0;
    for (let body = 0; body < this.count; body++)
      top = Math.max(top, this.position(body).z + this.halfExtent(body, new Vector3(0, 0, 1)));
    return top;
  }

  /** Half of the extent of a body along a unit direction of the world, m. */
  halfExtent(body: number, direction: Vector3, poses = this.shown): number {
    return halfExtent(this.size(body), direction.clone().applyMatrix3(this.axes(body, poses).transpose()));
  }

  /** The same of the newest state were the body not strained, m. */
  halfExtentUnstrained(body: number, direction: Vector3): number {
    return halfExtent(this.size(body), direction.clone().applyQuaternion(this.turn(body, this.newest).conjugate()));
  }
}

function halfExtent(size: Vector3, local: Vector3): number {
  return (Math.abs(local.x) * size.x + Math.abs(local.y) * size.y + Math.abs(local.z) * size.z) / 2;
}
