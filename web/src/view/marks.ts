// Outlines of blocks and ghosts of the free slots, drawn over the wood.

import { BoxGeometry, EdgesGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { sameSlot, type Slot, type SlotId } from '../engine/game-protocol';
import type { Bodies } from './bodies';

/** Largest number of blocks outlined as holders. */
const MAX_HOLDERS = 4;
/** Distance of an outline from the block, m. */
const OFFSET = 0.0006;

const GHOST = '#eda238';

const edges = new LineSegmentsGeometry().fromEdgesGeometry(new EdgesGeometry(new BoxGeometry(1, 1, 1)));

/** Lines differ in width and dashes as well, so that colour is never the only cue. */
function line(colour: string, width: number, dashed: boolean, through: boolean): LineSegments2 {
  const material = new LineMaterial({
    color: colour,
    linewidth: width,
    dashed,
    dashSize: 0.05,
    gapSize: 0.035,
    depthTest: !through,
    transparent: true,
  });
  const mark = new LineSegments2(edges, material);
  if (dashed) mark.computeLineDistances();
  mark.visible = false;
  mark.matrixAutoUpdate = false;
  mark.renderOrder = through ? 3 : 2;
  return mark;
}

interface Ghost {
  box: Mesh;
  outline: LineSegments2;
}

export interface MarkState {
  hovered: number | null;
  held: number | null;
  selected: number | null;
  holders: number[];
  slots: Slot[];
  /** Slot that attracts the block. */
  target: SlotId | null;
  /** Edge lengths of the block that the slots are for, m. */
  slotSize: Vector3 | null;
}

export class Marks {
  readonly group = new Group();
  private readonly hovered = line('#ffffff', 1.5, false, false);
  private readonly held = line('#fff4d6', 3, false, false);
  private readonly selected = line('#fff4d6', 2, false, false);
  private readonly holders = Array.from({ length: MAX_HOLDERS }, () => line('#d1461f', 3, true, true));
  private readonly ghosts: Ghost[] = [];
  private shown = '';

  constructor() {
    this.group.add(this.hovered, this.held, this.selected, ...this.holders);
    for (let i = 0; i < 3; i++) {
      const box = new Mesh(
        new BoxGeometry(1, 1, 1),
        new MeshBasicMaterial({ color: GHOST, transparent: true, opacity: 0.16, depthWrite: false }),
      );
      box.renderOrder = 2;
      box.matrixAutoUpdate = false;
      const outline = line(GHOST, 2, true, false);
      this.ghosts.push({ box, outline });
      this.group.add(box, outline);
    }
  }

  /** Shows the state; returns true if the picture changes. */
  show(bodies: Bodies, state: MarkState): boolean {
    const free = (body: number | null) =>
      body !== null && body !== state.held && !state.holders.includes(body) ? body : null;
    this.outline(this.held, bodies, state.held);
    this.outline(this.hovered, bodies, free(state.hovered));
    this.outline(this.selected, bodies, free(state.selected));
    this.holders.forEach((mark, i) => this.outline(mark, bodies, state.holders[i] ?? null));
    this.ghosts.forEach((ghost, i) => {
      const slot = state.slotSize ? state.slots[i] : undefined;
      ghost.box.visible = ghost.outline.visible = slot !== undefined;
      if (!slot) return;
      const target = sameSlot(slot, state.target);
      const [position, orientation] = [new Vector3(...slot.position), new Quaternion(...slot.orientation)];
      (ghost.box.material as MeshBasicMaterial).opacity = target ? 0.42 : 0.14;
      ghost.outline.material.linewidth = target ? 3.5 : 1.8;
      for (const mark of [ghost.box, ghost.outline]) mark.matrix.compose(position, orientation, state.slotSize!);
    });
    const shown = JSON.stringify([
      state.hovered,
      state.held,
      state.selected,
      state.holders,
      state.slots.map(s => s.position),
      state.target,
    ]);
    const changed = shown !== this.shown;
    this.shown = shown;
    return changed;
  }

  private outline(mark: LineSegments2, bodies: Bodies, body: number | null): void {
    mark.visible = body !== null && body < bodies.count;
    if (mark.visible) bodies.matrix(body!, bodies.size(body!).addScalar(2 * OFFSET), mark.matrix);
  }
}
