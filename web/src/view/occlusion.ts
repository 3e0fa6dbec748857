// Ambient occlusion from a coarse grid of the wood.
//
// Each cell stores the fraction of it that is filled. The shaders march from a surface into the
// grid in a few directions, which darkens gaps and the table under the tower without a pass over
// the screen.

import { Data3DTexture, LinearFilter, LinearMipmapLinearFilter, RedFormat, Vector3, type Matrix3 } from 'three';
import type { Bodies } from './bodies';

/** Edge of a cell, m: three to a block's height. */
const CELL = 0.006;
/** Half the width of the map, m; there is no occlusion outside. */
const HALF_WIDTH = 0.21;

export class Occlusion {
  readonly texture: Data3DTexture;
  readonly origin: Vector3;
  readonly extent: Vector3;
  private readonly cells: Uint8Array<ArrayBuffer>;
  private readonly n: [number, number, number];

  /** Creates a map for blocks up to a height of `top` metres. */
  constructor(top: number) {
    const wide = Math.ceil((2 * HALF_WIDTH) / CELL);
    const high = Math.ceil((top + 0.08) / CELL);
    this.n = [wide, wide, high];
    this.origin = new Vector3(-HALF_WIDTH, -HALF_WIDTH, 0);
    this.extent = new Vector3(wide, wide, high).multiplyScalar(CELL);
    this.cells = new Uint8Array(wide * wide * high);
    this.texture = new Data3DTexture(this.cells, wide, wide, high);
    this.texture.format = RedFormat;
    // Mip levels serve larger distances.
    this.texture.minFilter = LinearMipmapLinearFilter;
    this.texture.generateMipmaps = true;
    this.texture.magFilter = LinearFilter;
    this.texture.unpackAlignment = 1;
  }

  dispose(): void {
    this.texture.dispose();
  }

  /** Fills the map. `density`: fraction of the light that a block absorbs. */
  update(bodies: Bodies, density: number): void {
    this.cells.fill(0);
    for (let body = 0; body < bodies.count; body++) this.fill(bodies, body, 255 * density);
    this.texture.needsUpdate = true;
  }

  private fill(bodies: Bodies, body: number, full: number): void {
    const [nx, ny, nz] = this.n;
    const { origin, cells } = this;
    const centre = bodies.position(body).sub(origin);
    const half = bodies.size(body).multiplyScalar(0.5);
    const map = bodies.axes(body);
    const axes = columns(map);
    // Dual axes: a point's coordinate in the block is its product with one over its length. Without
    // strain they equal the axes.
    const across = columns(map.clone().invert().transpose());
    const lengths = across.map(axis => axis.length());
    const reach = (k: number) =>
      half.x * Math.abs(axes[0].getComponent(k)) +
      half.y * Math.abs(axes[1].getComponent(k)) +
      half.z * Math.abs(axes[2].getComponent(k));
    const from = (k: number) => Math.max(0, Math.floor((centre.getComponent(k) - reach(k)) / CELL - 0.5));
    const to = (k: number, n: number) => Math.min(n - 1, Math.ceil((centre.getComponent(k) + reach(k)) / CELL));
    const [x1, y1, z1] = [to(0, nx), to(1, ny), to(2, nz)];
    for (let z = from(2); z <= z1; z++) {
      for (let y = from(1); y <= y1; y++) {
        for (let x = from(0); x <= x1; x++) {
          const dx = (x + 0.5) * CELL - centre.x;
          const dy = (y + 0.5) * CELL - centre.y;
          const dz = (z + 0.5) * CELL - centre.z;
          let filled = 1;
          for (let k = 0; k < 3; k++) {
            const axis = across[k];
            const inside = half.getComponent(k) - Math.abs(dx * axis.x + dy * axis.y + dz * axis.z);
            const depth = inside / lengths[k] / CELL + 0.5;
            filled *= Math.min(1, Math.max(0, depth));
          }
          if (filled === 0) continue;
          const at = x + nx * (y + ny * z);
          cells[at] = Math.min(255, cells[at] + filled * full);
        }
      }
    }
  }

  /** Uniforms for shaders that include [`occlusionShader`]. */
  uniforms() {
    return { skyMap: { value: this.texture }, skyOrigin: { value: this.origin }, skyExtent: { value: this.extent } };
  }
}

function columns(map: Matrix3): [Vector3, Vector3, Vector3] {
  const all: [Vector3, Vector3, Vector3] = [new Vector3(), new Vector3(), new Vector3()];
  map.extractBasis(...all);
  return all;
}

/** Defines `float skyLight(vec3 position, vec3 normal)`, the visible fraction of the sky. */
export const occlusionShader = /* glsl */ `
uniform highp sampler3D skyMap;
uniform vec3 skyOrigin;
uniform vec3 skyExtent;

float filledAt(vec3 p, float level) {
  vec3 c = (p - skyOrigin) / skyExtent;
  vec3 inside = step(vec3(0.0), c) * step(c, vec3(1.0));
  return textureLod(skyMap, c, level).r * inside.x * inside.y * inside.z;
}

float seenAlong(vec3 p, vec3 d) {
  float seen = 1.0;
  seen *= 1.0 - 0.75 * filledAt(p + d * 0.005, 0.0);
  seen *= 1.0 - 0.85 * filledAt(p + d * 0.012, 0.6);
  seen *= 1.0 - 0.8 * filledAt(p + d * 0.026, 1.6);
  seen *= 1.0 - 0.7 * filledAt(p + d * 0.06, 2.6);
  return seen;
}

float skyLight(vec3 position, vec3 normal) {
  vec3 p = position + normal * 0.0035;
  float seen = 0.25 * seenAlong(p, normal);
#if SKY_DIRECTIONS > 1
  // Six directions around the normal, rotated from pixel to pixel.
  vec3 a = normalize(abs(normal.z) < 0.9 ? cross(normal, vec3(0.0, 0.0, 1.0)) : cross(normal, vec3(1.0, 0.0, 0.0)));
  vec3 b = cross(normal, a);
  float turn = 1.0472 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.00583715, 0.06711056))));
  for (int i = 0; i < 6; i++) {
    float angle = turn + 1.0472 * float(i);
    seen += 0.125 * seenAlong(p, normalize(normal + 1.2 * (cos(angle) * a + sin(angle) * b)));
  }
#else
  seen *= 4.0;
#endif
  return seen;
}
`;
