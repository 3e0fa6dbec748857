// Material of the blocks: light hardwood, cut from logs that differ from block to block.

import { MeshStandardMaterial } from 'three';
import type { Occlusion } from './occlusion';
import { shadowDefines, soften, type ShadowSpan } from './shadow';
import { addWood } from './wood-shader';

export interface WoodMaterial {
  material: MeshStandardMaterial;
  /** Sets the occlusion map, which changes with the scene. */
  setOcclusion(map: Occlusion): void;
  /** Sets the number of directions in which the sky is sampled: one or seven. */
  setDirections(directions: number): void;
}

/**
 * Returns a material for an instanced mesh with attributes `seed` (vec4, 0 to 1), `scale3` (vec3,
 * the block's size over that of the geometry) and `tint` (vec4, linear colour of a stain, and its
 * opacity).
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
    addWood(shader);
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
