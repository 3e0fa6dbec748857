// Shader of the wood.
//
// The wood is solid: its colour is a function of the position in the log, so that rings run round
// the end of a block into the lines of its sides. Lengths are in metres.

import type { WebGLProgramParametersWithUniforms } from 'three';
import { occlusionShader } from './occlusion';

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

// Colour of the wood at a position in the block (m), and its roughness in w.
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
  // A tint per block: lighter or darker, more yellow or more red.
  float light = 0.86 + 0.26 * fract(seed.y * 7.31 + seed.z);
  float warm = fract(seed.w * 5.77 + seed.x) - 0.5;
  colour *= light * vec3(1.0 + 0.05 * warm, 1.0, 1.0 - 0.16 * warm);
  return vec4(colour, 0.56 + 0.16 * late + 0.2 * end + 0.1 * grain);
}
`;

/** Adds wood, stain and ambient occlusion to the shader of a lit material. */
export function addWood(shader: WebGLProgramParametersWithUniforms): void {
  addVertices(shader);
  addFragments(shader);
}

function addVertices(shader: WebGLProgramParametersWithUniforms): void {
  shader.vertexShader = shader.vertexShader
    .replace(
      '#include <common>',
      `#include <common>
      attribute vec4 seed;
      attribute vec3 scale3;
      attribute vec4 tint;
      attribute float hatch;
      varying vec4 vTint;
      varying float vHatch;
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
      vHatch = hatch;
      vSpot = (instanceMatrix * vec4(position, 1.0)).xyz;
      vOut = normalize(mat3(instanceMatrix) * normal);`,
    );
}

function addFragments(shader: WebGLProgramParametersWithUniforms): void {
  shader.fragmentShader = shader.fragmentShader
    .replace(
      '#include <common>',
      `#include <common>
      varying vec4 vTint;
      varying float vHatch;
      varying vec3 vGrain;
      varying vec3 vFace;
      varying vec4 vSeed;
      varying vec3 vSpot;
      varying vec3 vOut;
      ${occlusionShader}
      ${woodShader}
      // A stain encodes a number: part of its colour does not depend on the light.
      #define STAIN_LIT 0.45
      #define STAIN_OWN 0.5
      // Period of a hatching, m, across its lines, which run askew over every face.
      #define HATCH 0.009`,
    )
    .replace(
      '#include <color_fragment>',
      `vec4 cut = wood(vGrain, vFace, vSeed);
      // The grain shows through a stain.
      float grain = 0.7 + 0.5 * dot(cut.rgb, vec3(0.30, 0.59, 0.11));
      diffuseColor.rgb = mix(cut.rgb, STAIN_LIT * vTint.rgb * grain, vTint.a);
      float across = dot(vGrain, vec3(1.0)) / HATCH;
      float line = smoothstep(0.1, 0.1 + 2.0 * fwidth(across), abs(fract(across) - 0.5) - 0.06);
      diffuseColor.rgb *= 1.0 - 0.42 * vHatch * (1.0 - line);`,
    )
    .replace('#include <roughnessmap_fragment>', `float roughnessFactor = mix(cut.w, 1.0, vTint.a);`)
    .replace('#include <emissivemap_fragment>', `totalEmissiveRadiance += STAIN_OWN * vTint.rgb * grain * vTint.a;`)
    .replace(
      '#include <aomap_fragment>',
      `float sky = skyLight(vSpot, vOut);
      // Light reflected by wood is warm.
      vec3 shade = mix(vec3(0.30, 0.21, 0.15), vec3(1.0), sky);
      reflectedLight.indirectDiffuse *= shade * mix(0.35, 1.0, sky);
      reflectedLight.directDiffuse *= mix(0.55, 1.0, sky);
      reflectedLight.directSpecular *= sky;`,
    );
}
