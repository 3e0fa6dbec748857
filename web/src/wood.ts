// The material of the blocks: light hardwood, cut from logs that differ from block to block.
//
// The wood is solid: its colour is a function of the place in the log, so that rings run round the end of a block into the lines of its
// sides. Lengths are in metres, as everywhere.

import { BufferAttribute, BufferGeometry, MeshStandardMaterial, Vector3 } from 'three';
import { occlusionShader, type Occlusion } from './occlusion';
import { shadowDefines, soften, type ShadowSpan } from './shadow';

/** Width of the chamfer along the edges of a block, m. */
const CHAMFER = 0.0009;

/** A box with chamfered edges, centred. Flat faces keep flat normals; the chamfers are bevels that catch the light. */
export function chamferedBox(size: Vector3, chamfer = CHAMFER): BufferGeometry {
  const half = size.clone().multiplyScalar(0.5);
  const corner = (s: number[], inset: number) =>
    new Vector3(...([0, 1, 2] as const).map(k => s[k] * (half.getComponent(k) - (k === inset ? 0 : chamfer))));
  const triangles: Vector3[][] = [];
  const polygon = (points: Vector3[]) => {
    const outward = points.reduce((sum, p) => sum.add(p), new Vector3());
    const normal = points[1].clone().sub(points[0]).cross(points[2].clone().sub(points[0]));
    const ring = normal.dot(outward) < 0 ? [...points].reverse() : points;
    for (let i = 2; i < ring.length; i++) triangles.push([ring[0], ring[i - 1], ring[i]]);
  };
  const signs = [-1, 1];
  for (let k = 0; k < 3; k++) {
    const [u, v] = [(k + 1) % 3, (k + 2) % 3];
    const at = (sk: number, su: number, sv: number) => {
      const s = [0, 0, 0];
      s[k] = sk;
      s[u] = su;
      s[v] = sv;
      return s;
    };
    for (const side of signs) {
      polygon([at(side, -1, -1), at(side, 1, -1), at(side, 1, 1), at(side, -1, 1)].map(s => corner(s, k)));
    }
    // The four edges along axis k.
    for (const su of signs) {
      for (const sv of signs) {
        const [a, b] = [at(-1, su, sv), at(1, su, sv)];
        polygon([corner(a, u), corner(b, u), corner(b, v), corner(a, v)]);
      }
    }
  }
  for (const x of signs)
    for (const y of signs) for (const z of signs) polygon([0, 1, 2].map(k => corner([x, y, z], k)));

  const position = new Float32Array(triangles.length * 9);
  const normals = new Float32Array(triangles.length * 9);
  triangles.forEach(([a, b, c], t) => {
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    [a, b, c].forEach((p, i) => {
      p.toArray(position, t * 9 + i * 3);
      normal.toArray(normals, t * 9 + i * 3);
    });
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  return geometry;
}

const woodShader = /* glsl */ `
float hash13(vec3 p) {
  p = fract(p * 0.1031);
  p += dot(p, p.zyx + 31.32);
  return fract((p.x + p.y) * p.z);
}

float noise3(vec3 p) {
  vec3 i = floor(p);
  vec3 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec2 e = vec2(0.0, 1.0);
  return mix(
    mix(mix(hash13(i), hash13(i + e.yxx), f.x), mix(hash13(i + e.xyx), hash13(i + e.yyx), f.x), f.y),
    mix(mix(hash13(i + e.xxy), hash13(i + e.yxy), f.x), mix(hash13(i + e.xyy), hash13(i + e.yyy), f.x), f.y),
    f.z);
}

// Colour of the wood at a place in the block (m), and in w its roughness.
vec4 wood(vec3 p, vec3 n, vec4 seed) {
  float turn = seed.x * 6.2832;
  vec2 pith = vec2(cos(turn), sin(turn)) * (0.018 + 0.06 * seed.y);
  vec3 q = p;
  q.yz += p.x * (seed.zw - 0.5) * vec2(0.16, 0.1);
  vec3 shift = seed.xyz * 97.0;
  float wave = 0.0040 * noise3(vec3(q.x * 14.0, q.yz * 38.0) + shift) + 0.0011 * noise3(vec3(q.x * 40.0, q.yz * 190.0) + shift);
  float rings = (length(q.yz - pith) + wave) / mix(0.0019, 0.0032, seed.w);
  float blur = fwidth(rings);
  float phase = fract(rings);
  float late = smoothstep(0.25, 0.93, phase) * (1.0 - smoothstep(0.93, 1.0, phase));
  late = mix(late, 0.36, smoothstep(0.25, 0.9, blur));
  float strength = 0.5 + 0.5 * noise3(vec3(floor(rings) * 1.7, q.x * 3.0, 0.5) + shift);

  // Fibres: long along the grain, fine across it; they fade before they would shimmer.
  vec3 fine = vec3(q.x * 55.0, q.yz * 1500.0);
  float grain = noise3(fine + shift) - 0.5;
  grain *= 1.0 - smoothstep(0.35, 1.1, max(fwidth(fine.y), fwidth(fine.z)));
  float cloud = noise3(vec3(q.x * 16.0, q.yz * 70.0) + shift.zxy) - 0.5;

  float end = smoothstep(0.6, 0.9, abs(n.x));
  vec3 early = vec3(0.760, 0.535, 0.325);
  vec3 dark = vec3(0.545, 0.325, 0.160);
  vec3 colour = mix(early, dark, late * strength * mix(0.62, 0.85, end));
  colour *= 1.0 + 0.16 * grain + 0.12 * cloud;
  colour *= mix(1.0, 0.80, end);
  // Each block its own tint: lighter or darker, more yellow or more red.
  float light = 0.86 + 0.26 * fract(seed.y * 7.31 + seed.z);
  float warm = fract(seed.w * 5.77 + seed.x) - 0.5;
  colour *= light * vec3(1.0 + 0.05 * warm, 1.0, 1.0 - 0.16 * warm);
  return vec4(colour, 0.56 + 0.16 * late + 0.2 * end + 0.1 * grain);
}
`;

export interface WoodMaterial {
  material: MeshStandardMaterial;
  /** Sets the map of what is filled; it changes with the scene. */
  setOcclusion(map: Occlusion): void;
  /** One direction or seven of looking for the sky. */
  setDirections(directions: number): void;
}

/**
 * Material for an instanced mesh with attributes `seed` (vec4, 0 to 1), `scale3` (vec3, the block's size over the geometry's) and `tint` (vec4, a colour that
 * stains the wood, and how much of it; linear).
 */
export function woodMaterial(span: ShadowSpan): WoodMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.6, metalness: 0, dithering: true });
  material.defines = { ...material.defines, SKY_DIRECTIONS: 7, ...shadowDefines(7) };
  const uniforms: Record<string, { value: unknown }> = {
    skyMap: { value: null },
    skyOrigin: { value: null },
    skyExtent: { value: null },
  };
  material.onBeforeCompile = shader => {
    Object.assign(shader.uniforms, uniforms);
    soften(shader, span);
    shader.vertexShader = shader.vertexShader
      .replace(
        '#include <common>',
        `#include <common>
        attribute vec4 seed;
        attribute vec3 scale3;
        attribute vec4 tint;
        varying vec4 vTint;
        varying vec3 vGrain;
        varying vec3 vFace;
        varying vec4 vSeed;
        varying vec3 vSpot;
        varying vec3 vOut;`,
      )
      .replace(
        '#include <begin_vertex>',
        `#include <begin_vertex>
        vGrain = position * scale3;
        vFace = normal;
        vSeed = seed;
        vTint = tint;
        vSpot = (instanceMatrix * vec4(position, 1.0)).xyz;
        vOut = normalize(mat3(instanceMatrix) * normal);`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace(
        '#include <common>',
        `#include <common>
        varying vec4 vTint;
        varying vec3 vGrain;
        varying vec3 vFace;
        varying vec4 vSeed;
        varying vec3 vSpot;
        varying vec3 vOut;
        ${occlusionShader}
        ${woodShader}
        // A stain tells a number: part of its colour is there whatever light falls on it.
        #define STAIN_LIT 0.45
        #define STAIN_OWN 0.5`,
      )
      .replace(
        '#include <color_fragment>',
        `vec4 cut = wood(vGrain, vFace, vSeed);
        // A stain lets the grain show.
        float grain = 0.7 + 0.5 * dot(cut.rgb, vec3(0.30, 0.59, 0.11));
        diffuseColor.rgb = mix(cut.rgb, STAIN_LIT * vTint.rgb * grain, vTint.a);`,
      )
      .replace('#include <roughnessmap_fragment>', `float roughnessFactor = mix(cut.w, 1.0, vTint.a);`)
      .replace('#include <emissivemap_fragment>', `totalEmissiveRadiance += STAIN_OWN * vTint.rgb * grain * vTint.a;`)
      .replace(
        '#include <aomap_fragment>',
        `float sky = skyLight(vSpot, vOut);
        // Light that has been on wood before is warm.
        vec3 shade = mix(vec3(0.30, 0.21, 0.15), vec3(1.0), sky);
        reflectedLight.indirectDiffuse *= shade * mix(0.35, 1.0, sky);
        reflectedLight.directDiffuse *= mix(0.55, 1.0, sky);
        reflectedLight.directSpecular *= sky;`,
      );
  };
  return {
    material,
    setOcclusion(map) {
      const next = map.uniforms();
      uniforms.skyMap.value = next.skyMap.value;
      uniforms.skyOrigin.value = next.skyOrigin.value;
      uniforms.skyExtent.value = next.skyExtent.value;
    },
    setDirections(directions) {
      if (material.defines!.SKY_DIRECTIONS === directions) return;
      Object.assign(material.defines!, { SKY_DIRECTIONS: directions }, shadowDefines(directions));
      material.needsUpdate = true;
    },
  };
}
