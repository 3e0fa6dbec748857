// The ghost: the tower of the other method, drawn over the one in wood as edges and as faces whose
// opacity grows with the distance.

import {
  BoxGeometry,
  Color,
  DynamicDrawUsage,
  EdgesGeometry,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LineSegments,
  Matrix4,
  Mesh,
  ShaderMaterial,
  type BufferGeometry,
} from 'three';
import type { Bodies } from './bodies';

/** Distance of a block from that in wood at which its ghost is most opaque, m. */
const FULL = 0.004;
/** Opacities without distance and at full distance. */
const FACE = { min: 0.05, max: 0.5 };
const EDGE = { min: 0.45, max: 0.95 };
const COLOUR = { light: '#1670e0', dark: '#7db4ff' };

const vertex = /* glsl */ `
attribute mat4 block;
attribute float distance01;
varying float vDistance;
varying vec3 vShadingNormal;
void main() {
  vDistance = distance01;
  vShadingNormal = normalize(mat3(block) * normal);
  gl_Position = projectionMatrix * viewMatrix * block * vec4(position, 1.0);
  // In front of wood at the same depth.
  gl_Position.z -= 3e-5 * gl_Position.w;
}
`;

const fragment = /* glsl */ `
uniform vec3 colour;
uniform vec2 opacity;
uniform float shaded;
varying float vDistance;
varying vec3 vShadingNormal;
void main() {
  float light = mix(1.0, 0.72 + 0.28 * vShadingNormal.z - 0.1 * vShadingNormal.x, shaded);
  gl_FragColor = vec4(colour * light, mix(opacity.x, opacity.y, vDistance));
  #include <colorspace_fragment>
}
`;

function material(opacity: { min: number; max: number }, shaded: boolean): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: {
      colour: { value: new Color() },
      opacity: { value: [opacity.min, opacity.max] },
      shaded: { value: shaded ? 1 : 0 },
    },
    vertexShader: vertex,
    fragmentShader: fragment,
    transparent: true,
    depthWrite: false,
  });
}

export class Ghost {
  readonly group = new Group();
  private readonly faces = new Mesh(new InstancedBufferGeometry() as BufferGeometry, material(FACE, true));
  private readonly edges = new LineSegments(new InstancedBufferGeometry() as BufferGeometry, material(EDGE, false));
  private matrices = new InstancedBufferAttribute(new Float32Array(0), 16);
  private distances = new InstancedBufferAttribute(new Float32Array(0), 1);

  constructor() {
    this.group.add(this.faces, this.edges);
    this.faces.renderOrder = 1;
    this.edges.renderOrder = 2;
    for (const part of [this.faces, this.edges]) part.frustumCulled = false;
    this.group.visible = false;
    this.setDark(false);
  }

  setDark(dark: boolean): void {
    for (const part of [this.faces, this.edges])
      part.material.uniforms.colour.value.set(COLOUR[dark ? 'dark' : 'light']);
  }

  hide(): void {
    this.group.visible = false;
  }

  /** Shows blocks, each at a distance (m) from that in wood. */
  show(bodies: Bodies, distances: Float32Array): void {
    if (this.distances.count !== bodies.count) this.allocate(bodies.count);
    const matrix = new Matrix4();
    for (let body = 0; body < bodies.count; body++) {
      bodies.matrix(body, bodies.size(body), matrix).toArray(this.matrices.array, 16 * body);
      this.distances.array[body] = Math.min(1, distances[body] / FULL);
    }
    this.matrices.needsUpdate = this.distances.needsUpdate = true;
    this.group.visible = true;
  }

  private allocate(count: number): void {
    this.matrices = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
    this.distances = new InstancedBufferAttribute(new Float32Array(count), 1);
    for (const attribute of [this.matrices, this.distances]) attribute.setUsage(DynamicDrawUsage);
    const box = new BoxGeometry(1, 1, 1);
    for (const [part, source] of [
      [this.faces, box],
      [this.edges, new EdgesGeometry(box)],
    ] as const) {
      const geometry = new InstancedBufferGeometry();
      geometry.setIndex(source.index);
      for (const name of ['position', 'normal']) {
        const attribute = source.getAttribute(name);
        if (attribute) geometry.setAttribute(name, attribute);
      }
      geometry.setAttribute('block', this.matrices);
      geometry.setAttribute('distance01', this.distances);
      geometry.instanceCount = count;
      part.geometry.dispose();
      part.geometry = geometry;
    }
  }
}
