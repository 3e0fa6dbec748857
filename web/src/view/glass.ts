// Transparent blocks: faint faces, and edges as lines. They share the instances of the wood.

import {
  BoxGeometry,
  EdgesGeometry,
  InstancedBufferGeometry,
  LineSegments,
  MeshBasicMaterial,
  ShaderMaterial,
  type BufferGeometry,
  type InstancedMesh,
  type Vector3,
} from 'three';

const FACE = 0.07;
const EDGE = { light: ['#5d4a36', 0.34], dark: ['#e2d3c0', 0.3] } as const;

const vertex = /* glsl */ `
attribute mat4 block;
void main() {
  gl_Position = projectionMatrix * viewMatrix * block * vec4(position, 1.0);
}
`;

const fragment = /* glsl */ `
uniform vec3 colour;
uniform float opacity;
void main() {
  gl_FragColor = vec4(colour, opacity);
  #include <colorspace_fragment>
}
`;

export class Glass {
  /** Replaces the wood. It writes no depth, so that objects behind it stay visible. */
  readonly faces = new MeshBasicMaterial({ color: '#b98a55', transparent: true, opacity: FACE, depthWrite: false });
  readonly edges: LineSegments<BufferGeometry, ShaderMaterial>;

  constructor() {
    const material = new ShaderMaterial({
      uniforms: { colour: { value: this.faces.color.clone() }, opacity: { value: 1 } },
      vertexShader: vertex,
      fragmentShader: fragment,
      transparent: true,
      depthWrite: false,
    });
    this.edges = new LineSegments(new InstancedBufferGeometry() as BufferGeometry, material);
    this.edges.frustumCulled = false;
    this.edges.visible = false;
    this.edges.renderOrder = 1;
    this.setDark(false);
  }

  setDark(dark: boolean): void {
    const [colour, opacity] = EDGE[dark ? 'dark' : 'light'];
    this.edges.material.uniforms.colour.value.set(colour);
    this.edges.material.uniforms.opacity.value = opacity;
  }

  /** Begins with new blocks: the instances of `mesh`, whose geometry has edge lengths `size`, m. */
  begin(mesh: InstancedMesh, size: Vector3): void {
    this.edges.geometry.dispose();
    const box = new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z));
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', box.getAttribute('position'));
    geometry.setAttribute('block', mesh.instanceMatrix);
    geometry.instanceCount = mesh.count;
    this.edges.geometry = geometry;
  }
}
