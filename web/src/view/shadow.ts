// Percentage-closer soft shadows: sharp near the block that casts them, soft far from it.
//
// A search around the point finds the mean depth of the blockers, and the shadow map is averaged
// over a disc whose radius follows from that depth. The disc is rotated from pixel to pixel, which
// hides the pattern of few samples.

import type { WebGLProgramParametersWithUniforms } from 'three';

/** Diameter of the lamp over its distance. */
const LAMP = 0.085;

/** Half the width of the shadow map and its depth, m. */
export interface ShadowSpan {
  half: { value: number };
  depth: { value: number };
}

const shader = /* glsl */ `
uniform float shadowHalf;
uniform float shadowDepth;

float softShadow(sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord) {
  vec3 at = shadowCoord.xyz / shadowCoord.w;
  if (at.x < 0.0 || at.x > 1.0 || at.y < 0.0 || at.y > 1.0 || at.z > 1.0) return 1.0;
  float here = at.z + shadowBias;
  float texel = 1.0 / shadowMapSize.x;
  float turn = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));

  float blockers = 0.0;
  float depths = 0.0;
  float search = max(2.0 * texel, 0.010 / shadowHalf);
  for (int i = 0; i < BLOCKER_SAMPLES; i++) {
    float angle = turn + 2.39996 * float(i);
    vec2 offset = search * sqrt((float(i) + 0.5) / float(BLOCKER_SAMPLES)) * vec2(cos(angle), sin(angle));
    float depth = texture2D(shadowMap, at.xy + offset).r;
    if (depth < here - 0.25 * length(offset)) {
      blockers += 1.0;
      depths += depth;
    }
  }
  if (blockers < 0.5) return 1.0;
  float distance = (here - depths / blockers) * shadowDepth;
  float radius = max(1.2 * texel, distance * ${(LAMP / 2).toFixed(4)} / (2.0 * shadowHalf));
  float light = 0.0;
  for (int i = 0; i < SHADOW_SAMPLES; i++) {
    float angle = turn + 2.39996 * float(i);
    vec2 offset = radius * sqrt((float(i) + 0.5) / float(SHADOW_SAMPLES)) * vec2(cos(angle), sin(angle));
    light += step(here - 0.12 * length(offset), texture2D(shadowMap, at.xy + offset).r);
  }
  return mix(1.0, light / float(SHADOW_SAMPLES), shadowIntensity);
}
#define getShadow softShadow
`;

/** Adds soft shadows to the shader of a lit material. */
export function soften(program: WebGLProgramParametersWithUniforms, span: ShadowSpan): void {
  program.uniforms.shadowHalf = span.half;
  program.uniforms.shadowDepth = span.depth;
  program.fragmentShader = program.fragmentShader.replace(
    '#include <shadowmap_pars_fragment>',
    `#include <shadowmap_pars_fragment>\n${shader}`,
  );
}

/** Returns the number of shadow samples for a number of sky directions. */
export function shadowDefines(directions: number): Record<string, number> {
  return directions > 1 ? { BLOCKER_SAMPLES: 10, SHADOW_SAMPLES: 18 } : { BLOCKER_SAMPLES: 8, SHADOW_SAMPLES: 8 };
}
