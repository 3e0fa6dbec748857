// How much of the sky a point sees, from a coarse map of where wood is.
//
// A grid of cells says which part of each is filled. The shaders walk from a surface into the grid in a few directions: holes and the
// table under the tower come out soft and dark, with no pass over the screen, on every device alike.

import { Data3DTexture, LinearFilter, LinearMipmapLinearFilter, RedFormat, Vector3, type Matrix3 } from 'three';
import type { Bodies } from './bodies';

/** Edge of a cell, m: three to a block's height. */
const CELL = 0.006;
/** Half the width of the map, m. What lies farther out is drawn without it. */
const REACH = 0.21;

export class Occlusion {
  readonly texture: Data3DTexture;
  readonly origin: Vector3;
  readonly extent: Vector3;
  private readonly cells: Uint8Array<ArrayBuffer>;
  private readonly n: [number, number, number];

  /** A map for blocks up to `top` metres. */
  constructor(top: number) {
    const wide = Math.ceil((2 * REACH) / CELL);
    const high = Math.ceil((top + 0.08) / CELL);
    this.n = [wide, wide, high];
    this.origin = new Vector3(-REACH, -REACH, 0);
    this.extent = new Vector3(wide, wide, high).multiplyScalar(CELL);
    this.cells = new Uint8Array(wide * wide * high);
    this.texture = new Data3DTexture(this.cells, wide, wide, high);
    this.texture.format = RedFormat;
    // Coarser levels of the map serve what is farther away.
    this.texture.minFilter = LinearMipmapLinearFilter;
    this.texture.generateMipmaps = true;
    this.texture.magFilter = LinearFilter;
    this.texture.unpackAlignment = 1;
  }

  dispose(): void {
    this.texture.dispose();
  }

  /** `dense`: part of the light that a block takes. */
  update(bodies: Bodies, dense: number): void {
    this.cells.fill(0);
    for (let body = 0; body < bodies.count; body++) this.fill(bodies, body, 255 * dense);
    this.texture.needsUpdate = true;
  }

  private fill(bodies: Bodies, body: number, full: number): void {
    const [nx, ny, nz] = this.n;
    const { origin, cells } = this;
    const centre = bodies.position(body).sub(origin);
    const half = bodies.size(body).multiplyScalar(0.5);
    const map = bodies.axes(body);
    const axes = columns(map);
    // A point's coordinates in the block are its products with these, over their lengths: for a block that is not strained the axes again.
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

/** `float skyLight(vec3 position, vec3 normal)`: the part of the sky that is seen, 0 to 1. */
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
  // Six directions around the normal, turned from pixel to pixel.
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
