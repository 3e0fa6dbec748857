// The springs view: springs as rods between particles, particles as beads.
//
// Colour and shape encode the force: a spring in compression is thick and dark, one in tension
// thin, bright and dashed, one without force a hairline. Rods are ribbons that face the viewer,
// shaded as cylinders, with true depth.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  Points,
  ShaderMaterial,
  Vector2,
} from 'three';
import { ENDS, LATTICE_STRIDE, PARTICLES, SPRINGS } from './lattice';

/** Thickness of a rod without force, and the additions at full compression and full tension, m. */
export const THICKNESS = { none: 0.00028, push: 0.0017, pull: 0.0009 };
/** Length of a dash with its gap, m, and the fraction of it that is drawn. */
export const DASH = { length: 0.0026, drawn: 0.62 };
/** Diameter of a bead, m. */
const BEAD = 0.0017;
/** Smallest widths of a rod and a bead, device px. */
const MIN_WIDTH = { rod: 1, bead: 2.5 };
/** Level below which a spring in tension is not dashed. */
const DASHED = 0.25;

/** Colours that differ for any colour vision, on light and dark backgrounds. */
export const COLOURS = {
  light: { push: '#16408c', none: '#a79e92', pull: '#ef7d0e', bead: '#4a433d' },
  dark: { push: '#3f7be0', none: '#6f6860', pull: '#ffbe63', bead: '#d8cfc4' },
};

const sizes = /* glsl */ `
uniform vec2 viewport;

/** Device px per metre at a position in clip space. */
float pixels(vec4 clip) {
  return 0.5 * viewport.y * projectionMatrix[1][1] / clip.w;
}
`;

const rodVertex = /* glsl */ `
${sizes}
uniform float forceEnd;
attribute vec3 start;
attribute vec3 finish;
attribute float force;
varying float vAcross;
varying float vAlong;
varying float vLevel;

void main() {
  float level = sign(force) * sqrt(min(1.0, abs(force) / forceEnd));
  vec4 a = projectionMatrix * viewMatrix * vec4(start, 1.0);
  vec4 b = projectionMatrix * viewMatrix * vec4(finish, 1.0);
  vec4 here = position.x < 0.5 ? a : b;
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  float visible = length(along);
  along = visible > 1e-3 ? along / visible : vec2(1.0, 0.0);
  float thickness = ${THICKNESS.none} + (level < 0.0 ? ${THICKNESS.push} * -level : ${THICKNESS.pull} * level);
  float wide = max(${MIN_WIDTH.rod.toFixed(1)}, thickness * pixels(here));
  here.xy += vec2(-along.y, along.x) * position.y * wide / viewport * here.w;
  // Of rods that cross in one plane the one with the larger force is in front, which avoids flicker.
  here.z -= 4e-6 * abs(level) * here.w;
  vAcross = position.y;
  vAlong = position.x * distance(start, finish);
  vLevel = level;
  gl_Position = here;
}
`;

const rodFragment = /* glsl */ `
uniform vec3 pushColour;
uniform vec3 noneColour;
uniform vec3 pullColour;
varying float vAcross;
varying float vAlong;
varying float vLevel;

void main() {
  if (vLevel > ${DASHED} && fract(vAlong / ${DASH.length} + 0.5 * ${DASH.drawn}) > ${DASH.drawn}) discard;
  vec3 colour = mix(noneColour, vLevel < 0.0 ? pushColour : pullColour, smoothstep(0.0, 0.6, abs(vLevel)));
  // Multisampling may extrapolate beyond the edges of a ribbon.
  float facing = sqrt(1.0 - 0.8 * min(1.0, vAcross * vAcross));
  gl_FragColor = vec4(colour * (0.65 + 0.35 * facing), 1.0);
  #include <colorspace_fragment>
}
`;

const beadVertex = /* glsl */ `
${sizes}
void main() {
  vec4 here = projectionMatrix * viewMatrix * vec4(position, 1.0);
  gl_PointSize = max(${MIN_WIDTH.bead.toFixed(1)}, ${BEAD} * pixels(here));
  here.z -= 1e-5 * here.w;
  gl_Position = here;
}
`;

const beadFragment = /* glsl */ `
uniform vec3 beadColour;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float out2 = dot(at, at);
  if (out2 > 1.0) discard;
  float light = 0.62 + 0.38 * sqrt(1.0 - out2) - 0.18 * (at.x + at.y);
  gl_FragColor = vec4(beadColour * light, 1.0);
  #include <colorspace_fragment>
}
`;

function dynamic<A extends BufferAttribute>(attribute: A): A {
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

export class SpringsView {
  readonly group = new Group();
  private readonly uniforms = {
    viewport: { value: new Vector2(1, 1) },
    forceEnd: { value: 1 },
    pushColour: { value: new Color() },
    noneColour: { value: new Color() },
    pullColour: { value: new Color() },
    beadColour: { value: new Color() },
  };
  private readonly rodMaterial = new ShaderMaterial({
    uniforms: this.uniforms,
    vertexShader: rodVertex,
    fragmentShader: rodFragment,
  });
  private readonly beadMaterial = new ShaderMaterial({
    uniforms: this.uniforms,
    vertexShader: beadVertex,
    fragmentShader: beadFragment,
  });
  private rods = new Mesh(new InstancedBufferGeometry(), this.rodMaterial);
  private beads = new Points(new BufferGeometry(), this.beadMaterial);
  private bodies = 0;

  constructor() {
    this.group.add(this.rods, this.beads);
    for (const part of [this.rods, this.beads]) part.frustumCulled = false;
    this.group.visible = false;
    this.setDark(false);
  }

  /** Number of springs in the picture. */
  get shown(): number {
    return this.group.visible ? this.bodies * SPRINGS : 0;
  }

  setDark(dark: boolean): void {
    const { push, none, pull, bead } = COLOURS[dark ? 'dark' : 'light'];
    this.uniforms.pushColour.value.set(push);
    this.uniforms.noneColour.value.set(none);
    this.uniforms.pullColour.value.set(pull);
    this.uniforms.beadColour.value.set(bead);
  }

  /** Size of the picture, device px. */
  resize(width: number, height: number): void {
    this.uniforms.viewport.value.set(width, height);
  }

  /** Shows springs, with the end of the scale at `end` (N); null hides them. */
  show(lattices: Float32Array | null, end: number): void {
    this.group.visible = lattices !== null;
    if (!lattices) return;
    const bodies = lattices.length / LATTICE_STRIDE;
    if (bodies !== this.bodies) this.allocate(bodies);
    this.uniforms.forceEnd.value = end;
    const { start, finish, force } = this.rods.geometry.attributes;
    const { position } = this.beads.geometry.attributes;
    for (let body = 0; body < bodies; body++) {
      const from = body * LATTICE_STRIDE;
      const particles = lattices.subarray(from, from + 3 * PARTICLES);
      position.array.set(particles, body * 3 * PARTICLES);
      force.array.set(lattices.subarray(from + 3 * PARTICLES, from + LATTICE_STRIDE), body * SPRINGS);
      ENDS.forEach(([i, j], n) => {
        const at = 3 * (body * SPRINGS + n);
        for (let k = 0; k < 3; k++) {
          start.array[at + k] = particles[3 * i + k];
          finish.array[at + k] = particles[3 * j + k];
        }
      });
    }
    for (const attribute of [start, finish, force, position]) attribute.needsUpdate = true;
  }

  private allocate(bodies: number): void {
    this.bodies = bodies;
    this.rods.geometry.dispose();
    this.beads.geometry.dispose();
    const rods = new InstancedBufferGeometry();
    // A ribbon: x along it from 0 to 1, y across from -1 to 1.
    rods.setAttribute('position', new BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    rods.setIndex([0, 1, 2, 0, 2, 3]);
    const springs = bodies * SPRINGS;
    rods.setAttribute('start', dynamic(new InstancedBufferAttribute(new Float32Array(3 * springs), 3)));
    rods.setAttribute('finish', dynamic(new InstancedBufferAttribute(new Float32Array(3 * springs), 3)));
    rods.setAttribute('force', dynamic(new InstancedBufferAttribute(new Float32Array(springs), 1)));
    rods.instanceCount = springs;
    this.rods.geometry = rods;
    const beads = new BufferGeometry();
    beads.setAttribute('position', dynamic(new BufferAttribute(new Float32Array(3 * PARTICLES * bodies), 3)));
    this.beads.geometry = beads;
  }
}
