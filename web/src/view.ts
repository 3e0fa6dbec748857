// The picture: blocks, table, light, shadow and marks.

import {
  BasicShadowMap,
  DirectionalLight,
  DynamicDrawUsage,
  HemisphereLight,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  NeutralToneMapping,
  Scene,
  Vector3,
  WebGLRenderer,
  type BufferGeometry,
} from 'three';
import type { Bodies } from './bodies';
import { Marks } from './marks';
import { Occlusion } from './occlusion';
import type { Orbit } from './orbit';
import type { Tier } from './quality';
import type { ShadowSpan } from './shadow';
import { Table } from './table';
import { chamferedBox, woodMaterial } from './wood';

/** Change of a pose that shows in the picture, m. */
const VISIBLE = 1e-5;

/** Numbers from 0 to 1 that look random and are the same for the same block. */
function scatter(body: number, salt: number): number {
  let h = Math.imul(body + 1, 0x9e3779b1) ^ Math.imul(salt + 1, 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
  h = Math.imul(h ^ (h >>> 12), 0x297a2d39);
  return ((h ^ (h >>> 15)) >>> 0) / 2 ** 32;
}

export class View {
  readonly marks = new Marks();
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight('#fff1dd', 2.9);
  private readonly sky = new HemisphereLight('#f2f3f5', '#c2ab90', 1.5);
  private readonly span: ShadowSpan = { half: { value: 1 }, depth: { value: 1 } };
  private readonly table = new Table(this.span);
  private readonly wood = woodMaterial(this.span);
  private mesh: InstancedMesh<BufferGeometry> | null = null;
  private occlusion: Occlusion | null = null;
  private nominal = new Vector3(1, 1, 1);
  private stale = true;
  private ratio = 1;

  /** Throws where the browser has no WebGL 2. `scale`: part of the full resolution, for devices that must be spared. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly orbit: Orbit,
    private readonly scale: number,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: scale >= 1, alpha: true, powerPreference: 'high-performance' });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.0;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = BasicShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.sun.castShadow = true;
    this.sun.shadow.bias = -0.0002;
    this.sun.shadow.normalBias = 0.0009;
    this.sun.shadow.intensity = 0.92;
    this.scene.add(this.sun, this.sun.target, this.sky, this.table.mesh, this.marks.group);
    this.setDark(false);
  }

  /** A new set of blocks. */
  begin(bodies: Bodies): void {
    this.mesh?.geometry.dispose();
    this.mesh?.removeFromParent();
    this.mesh?.dispose();
    this.occlusion?.dispose();
    this.nominal = bodies.size(0);
    const geometry = chamferedBox(this.nominal);
    const seeds = new Float32Array(4 * bodies.count);
    const scales = new Float32Array(3 * bodies.count);
    for (let body = 0; body < bodies.count; body++) {
      for (let k = 0; k < 4; k++) seeds[4 * body + k] = scatter(body, k);
      bodies
        .size(body)
        .divide(this.nominal)
        .toArray(scales, 3 * body);
    }
    geometry.setAttribute('seed', new InstancedBufferAttribute(seeds, 4));
    geometry.setAttribute('scale3', new InstancedBufferAttribute(scales, 3));
    this.mesh = new InstancedMesh(geometry, this.wood.material, bodies.count);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.scene.add(this.mesh);
    const top = bodies.top();
    this.occlusion = new Occlusion(top);
    this.wood.setOcclusion(this.occlusion);
    this.table.setOcclusion(this.occlusion);
    this.light(top);
    this.stale = true;
  }

  resize(width: number, height: number, tier: Tier): void {
    this.ratio = Math.min(window.devicePixelRatio, tier.pixels) * this.scale;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height, false);
    this.setTier(tier);
  }

  setDark(dark: boolean): void {
    this.table.setColour(dark ? '#45413e' : '#dedad3');
    this.sun.intensity = dark ? 2.5 : 2.9;
    this.sky.intensity = dark ? 1.05 : 1.5;
    this.stale = true;
  }

  /** The picture must be drawn anew, whatever moved. */
  invalidate(): void {
    this.stale = true;
  }

  /** Takes over the shown poses; `change` is the largest of them. Whether the picture changes. */
  follow(bodies: Bodies, change: number): boolean {
    if (!this.mesh || !this.occlusion) return false;
    const moved = change > VISIBLE || this.stale;
    if (moved) {
      const matrix = new Matrix4();
      for (let body = 0; body < bodies.count; body++) {
        matrix.compose(bodies.position(body), bodies.turn(body), bodies.size(body).divide(this.nominal));
        this.mesh.setMatrixAt(body, matrix);
      }
      this.mesh.instanceMatrix.needsUpdate = true;
      this.occlusion.update(bodies);
      this.renderer.shadowMap.needsUpdate = true;
    }
    this.stale = false;
    return moved;
  }

  draw(): void {
    this.renderer.render(this.scene, this.orbit.camera);
  }

  private setTier(tier: Tier): void {
    this.wood.setDirections(tier.directions);
    this.table.setDirections(tier.directions);
    const size = Math.min(tier.shadow, this.scale < 1 ? 512 : tier.shadow);
    if (this.sun.shadow.mapSize.x !== size) {
      this.sun.shadow.mapSize.set(size, size);
      this.sun.shadow.map?.dispose();
      this.sun.shadow.map = null;
    }
    this.stale = true;
  }

  /** Sun from the upper left of the first view; its shadow map covers the tower and what may fall around it. */
  private light(top: number): void {
    const middle = new Vector3(0, 0, top / 2);
    this.sun.position.copy(middle).addScaledVector(new Vector3(0.35, -1.0, 1.15).normalize(), 2);
    this.sun.target.position.copy(middle);
    const span = Math.max(0.36, top * 0.75);
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -span;
    camera.right = camera.top = span;
    camera.near = 0.5;
    camera.far = 4;
    this.span.half.value = span;
    this.span.depth.value = camera.far - camera.near;
    camera.updateProjectionMatrix();
  }
}
