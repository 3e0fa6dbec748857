// The picture of a tower: blocks, table, light, shadow and marks.

import {
  BasicShadowMap,
  Color,
  DirectionalLight,
  DynamicDrawUsage,
  HemisphereLight,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  NeutralToneMapping,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
  type BufferGeometry,
  type Material,
  type Object3D,
} from 'three';
import type { Bodies } from './bodies';
import { chamferedBox } from './chamfered-box';
import { Glass } from './glass';
import type { Lattices } from './lattice';
import { Marks } from './marks';
import { Occlusion } from './occlusion';
import type { Orbit } from './orbit';
import type { Tier } from './quality';
import type { ShadowSpan } from './shadow';
import { SpringsView } from './springs';
import { Table } from './table';
import { woodMaterial } from './wood';

/** Smallest visible change of a pose, m. */
const VISIBLE = 1e-5;
/** Fraction of the sun's light that a shadow takes. */
const SHADOW = { wood: 0.92, glass: 0.4 };
/** Fraction of the sky's light that transparent blocks take. */
const GLASS_DENSITY = 0.3;

/** Returns a pseudo-random number from 0 to 1 for a block. */
function hashed(body: number, salt: number): number {
  let h = Math.imul(body + 1, 0x9e3779b1) ^ Math.imul(salt + 1, 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
  h = Math.imul(h ^ (h >>> 12), 0x297a2d39);
  return ((h ^ (h >>> 15)) >>> 0) / 2 ** 32;
}

export class TowerView {
  readonly marks = new Marks();
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight('#fff1dd', 2.9);
  private readonly sky = new HemisphereLight('#f2f3f5', '#c2ab90', 1.5);
  private readonly span: ShadowSpan = { half: { value: 1 }, depth: { value: 1 } };
  private readonly table = new Table(this.span);
  private readonly wood = woodMaterial(this.span);
  private readonly glass = new Glass();
  private readonly springs = new SpringsView();
  private mesh: InstancedMesh<BufferGeometry, Material> | null = null;
  private occlusion: Occlusion | null = null;
  private nominal = new Vector3(1, 1, 1);
  /** True while the blocks are transparent. */
  private clear = false;
  private stale = true;
  private ratio = 1;

  /** `scale`: fraction of the full resolution. Throws where the browser has no WebGL 2. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly orbit: Orbit,
    private readonly scale: number,
  ) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: scale >= 1,
      alpha: true,
      powerPreference: 'high-performance',
    });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1.0;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = BasicShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.sun.castShadow = true;
    this.sun.shadow.bias = -0.0002;
    this.sun.shadow.normalBias = 0.0009;
    this.sun.shadow.intensity = SHADOW.wood;
    this.scene.add(
      this.sun,
      this.sun.target,
      this.sky,
      this.table.mesh,
      this.marks.group,
      this.glass.edges,
      this.springs.group,
    );
    this.setDark(false);
  }

  /** Begins with new blocks. */
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
      for (let k = 0; k < 4; k++) seeds[4 * body + k] = hashed(body, k);
      bodies
        .size(body)
        .divide(this.nominal)
        .toArray(scales, 3 * body);
    }
    geometry.setAttribute('seed', new InstancedBufferAttribute(seeds, 4));
    geometry.setAttribute('scale3', new InstancedBufferAttribute(scales, 3));
    geometry.setAttribute('tint', new InstancedBufferAttribute(new Float32Array(4 * bodies.count), 4));
    geometry.setAttribute('hatch', new InstancedBufferAttribute(new Float32Array(bodies.count), 1));
    this.mesh = new InstancedMesh(geometry, this.wood.material, bodies.count);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.scene.add(this.mesh);
    this.glass.begin(this.mesh, this.nominal);
    this.showSprings(null, 1);
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
    this.springs.resize(width * this.ratio, height * this.ratio);
    this.setTier(tier);
  }

  setDark(dark: boolean): void {
    this.glass.setDark(dark);
    this.springs.setDark(dark);
    this.table.setColour(dark ? '#45413e' : '#dedad3');
    this.sun.intensity = dark ? 2.5 : 2.9;
    this.sky.intensity = dark ? 1.05 : 1.5;
    this.stale = true;
  }

  /** Adds an object to the picture. */
  add(object: Object3D): void {
    this.scene.add(object);
  }

  /** Requests a new picture even if nothing moved. */
  invalidate(): void {
    this.stale = true;
  }

  /** Number of springs in the picture. */
  get springsShown(): number {
    return this.springs.shown;
  }

  /**
   * Draws springs in transparent blocks, with the end of their scale at `end` (N); wood where they
   * are null.
   */
  showSprings(lattices: Lattices['shown'], end: number): void {
    this.springs.show(lattices, end);
    const clear = lattices !== null;
    if (this.mesh) this.mesh.material = clear ? this.glass.faces : this.wood.material;
    if (clear === this.clear) return;
    this.clear = this.glass.edges.visible = clear;
    this.sun.shadow.intensity = clear ? SHADOW.glass : SHADOW.wood;
    this.stale = true;
  }

  /**
   * Stains each block with its colour (red, green and blue as on the screen) by a part from 0 to 1;
   * null leaves wood.
   */
  stain(colours: ([number, number, number] | null)[] | null, part = 1): void {
    const tint = this.mesh?.geometry.getAttribute('tint');
    if (!tint) return;
    const colour = new Color();
    for (let body = 0; body < tint.count; body++) {
      const stain = colours?.[body] ?? null;
      const [r, g, b] = stain ?? [0, 0, 0];
      colour.setRGB(r, g, b, SRGBColorSpace);
      tint.setXYZW(body, colour.r, colour.g, colour.b, stain ? part : 0);
    }
    tint.needsUpdate = true;
    this.stale = true;
  }

  /** Hatches blocks. */
  hatch(blocks: ReadonlySet<number>): void {
    const hatch = this.mesh?.geometry.getAttribute('hatch');
    if (!hatch) return;
    for (let body = 0; body < hatch.count; body++) hatch.setX(body, blocks.has(body) ? 1 : 0);
    hatch.needsUpdate = true;
    this.stale = true;
  }

  /**
   * Takes the poses in the picture, whose largest change is `change` (m); returns true if the
   * picture changes.
   */
  follow(bodies: Bodies, change: number): boolean {
    if (!this.mesh || !this.occlusion) return false;
    const moved = change > VISIBLE || this.stale;
    if (moved) {
      const matrix = new Matrix4();
      for (let body = 0; body < bodies.count; body++) {
        this.mesh.setMatrixAt(body, bodies.matrix(body, bodies.size(body).divide(this.nominal), matrix));
      }
      this.mesh.instanceMatrix.needsUpdate = true;
      this.occlusion.update(bodies, this.clear ? GLASS_DENSITY : 1);
      this.renderer.shadowMap.needsUpdate = true;
    }
    this.stale = false;
    return moved;
  }

  draw(): void {
    this.renderer.render(this.scene, this.orbit.camera);
  }

  /** Frees the context of the graphics. */
  dispose(): void {
    this.renderer.dispose();
    this.renderer.forceContextLoss();
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

  /**
   * Sun from the upper left of the first view; its shadow map covers the tower and what may fall
   * around it.
   */
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
