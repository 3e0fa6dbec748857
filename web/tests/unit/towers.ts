// Towers for tests of geometry: rows of three, each crossing the one below.

import { Quaternion, Vector3 } from 'three';
import { Bodies } from '../../src/view/bodies';

export const SIZE = new Vector3(0.081, 0.0268, 0.018);
export const PITCH = SIZE.y + 0.0003;

/**
 * Rows as text, bottom first: `x` is a block, `.` none. The whole is turned by `yaw` about the
 * vertical.
 */
export function tower(rows: string[], yaw = 0): Bodies {
  const sizes: number[] = [];
  const poses: number[] = [];
  rows.forEach((row, r) => {
    [...row].forEach((cell, c) => {
      if (cell !== 'x') return;
      const side = (c - 1) * PITCH;
      const position = new Vector3(r % 2 ? side : 0, r % 2 ? 0 : side, (r + 0.5) * SIZE.z).applyAxisAngle(
        new Vector3(0, 0, 1),
        yaw,
      );
      const rotation = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw + (r % 2) * (Math.PI / 2));
      sizes.push(...SIZE.toArray());
      poses.push(...position.toArray(), ...rotation.toArray());
    });
  });
  return new Bodies(Float32Array.from(sizes), Float32Array.from(poses));
}
