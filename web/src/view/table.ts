// The table: a matt surface that fades into the background of the page.

import { CircleGeometry, Color, Mesh, MeshStandardMaterial } from 'three';
import { occlusionShader, type Occlusion } from './occlusion';
import { shadowDefines, soften, type ShadowSpan } from './shadow';

/** Radii at which the fade begins and ends, m. */
const FADE = [0.3, 1.5];

export class Table {
  readonly mesh: Mesh<CircleGeometry, MeshStandardMaterial>;
  private readonly uniforms: Record<string, { value: unknown }> = {
    skyMap: { value: null },
    skyOrigin: { value: null },
    skyExtent: { value: null },
  };

  constructor(span: ShadowSpan) {
    const material = new MeshStandardMaterial({ roughness: 0.95, metalness: 0, transparent: true, dithering: true });
    material.defines = { ...material.defines, SKY_DIRECTIONS: 7, ...shadowDefines(7) };
    material.onBeforeCompile = shader => {
      Object.assign(shader.uniforms, this.uniforms);
      soften(shader, span);
      shader.vertexShader = shader.vertexShader
        .replace('#include <common>', '#include <common>\nvarying vec3 vSpot;')
        .replace('#include <begin_vertex>', '#include <begin_vertex>\nvSpot = position;');
      shader.fragmentShader = shader.fragmentShader
        .replace('#include <common>', `#include <common>\nvarying vec3 vSpot;\n${occlusionShader}`)
        .replace(
          '#include <aomap_fragment>',
          `float sky = skyLight(vSpot, vec3(0.0, 0.0, 1.0));
          reflectedLight.indirectDiffuse *= mix(vec3(0.16, 0.12, 0.10), vec3(1.0), sky);
          reflectedLight.directDiffuse *= mix(0.4, 1.0, sky);`,
        )
        .replace(
          '#include <opaque_fragment>',
          `// Noise hides the rings of eight-bit opacity.
          float grainOfFade = (fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5) / 128.0;
          diffuseColor.a = saturate(1.0 - smoothstep(${FADE[0].toFixed(2)}, ${FADE[1].toFixed(2)}, length(vSpot.xy)) + grainOfFade);
          #include <opaque_fragment>`,
        );
    };
    this.mesh = new Mesh(new CircleGeometry(FADE[1], 96), material);
    this.mesh.receiveShadow = true;
    // Drawn first, as it is transparent at its edge.
    this.mesh.renderOrder = -1;
  }

  setColour(colour: string): void {
    this.mesh.material.color = new Color(colour);
  }

  setOcclusion(map: Occlusion): void {
    const next = map.uniforms();
    this.uniforms.skyMap.value = next.skyMap.value;
    this.uniforms.skyOrigin.value = next.skyOrigin.value;
    this.uniforms.skyExtent.value = next.skyExtent.value;
  }

  setDirections(directions: number): void {
    const { material } = this.mesh;
    if (material.defines!.SKY_DIRECTIONS === directions) return;
    Object.assign(material.defines!, { SKY_DIRECTIONS: directions }, shadowDefines(directions));
    material.needsUpdate = true;
  }
}
