// Figures on blocks: one on the visible end of each, or on another visible face. They are text over
// the picture, as sharp as the screen allows and never larger than their face.

import { Vector3 } from 'three';
import type { Bodies } from '../view/bodies';
import { visibleFace } from '../view/faces';
import type { Orbit } from '../view/orbit';

export interface Label {
  text: string;
  /** True on a dark block, which takes light text. */
  dark: boolean;
  /** True if the label is highlighted. */
  marked: boolean;
}

/** Font sizes, px. */
const FONT = { min: 8, max: 13 };
/** Height of the text over that of its face, and width of a character over its height. */
const FILL = 0.68;
const CHARACTER_WIDTH = 0.64;
/** Width of the frame of a marked label, px. */
const FRAME = 5;
/**
 * Time between two searches for visible faces, s: positions on the screen follow in every picture.
 */
const SEARCH_INTERVAL = 0.1;

/** A labelled face in the block's frame: its middle, and half its edges across and up, m. */
interface Face {
  middle: Vector3;
  across: Vector3;
  up: Vector3;
}

export class Labels {
  private readonly spans: HTMLSpanElement[] = [];
  private labels: (Label | null)[] = [];
  private faces: (Face | null)[] = [];
  private searchedAt = 0;
  private stale = false;
  /** Number of visible labels. */
  shown = 0;
  /** Number of labels whose face is too small on the screen. */
  cramped = 0;

  /** `element`: lies over the picture. */
  constructor(private readonly element: HTMLElement) {}

  /** Sets the label of each block; null removes one, or all of them. */
  set(labels: (Label | null)[] | null): void {
    this.labels = labels ?? [];
    this.element.hidden = labels === null;
    this.shown = this.cramped = 0;
    while (this.spans.length > this.labels.length) this.spans.pop()!.remove();
    while (this.spans.length < this.labels.length)
      this.spans.push(this.element.appendChild(document.createElement('span')));
    this.labels.forEach((label, body) => {
      this.spans[body].textContent = label?.text ?? '';
      this.spans[body].className = [label?.dark ? 'dark' : '', label?.marked ? 'marked' : ''].join(' ').trim();
      this.spans[body].hidden = true;
    });
    this.faces = [];
    this.stale = true;
    this.searchedAt = 0;
  }

  /** Moves the labels to their blocks at a wall time, s. `moved`: blocks or camera have moved. */
  follow(bodies: Bodies, orbit: Orbit, moved: boolean, now: number): void {
    if (this.labels.length !== bodies.count) return;
    if (moved) this.stale = true;
    if (!this.stale) return;
    if (now - this.searchedAt > SEARCH_INTERVAL) {
      this.searchedAt = now;
      this.stale = false;
      this.faces = this.labels.map((label, body) => (label ? labelledFace(bodies, orbit, body) : null));
    }
    this.shown = this.cramped = 0;
    this.faces.forEach((face, body) => this.show(face, body, bodies, orbit));
  }

  private show(face: Face | null, body: number, bodies: Bodies, orbit: Orbit): void {
    const span = this.spans[body];
    span.hidden = true;
    if (!face) return;
    const project = (point: Vector3) => orbit.project(bodies.surface(body, point));
    const at = project(face.middle);
    const [side, top] = [face.across, face.up].map(half => project(face.middle.clone().add(half)));
    const halfWidth = Math.hypot(side.x - at.x, side.y - at.y);
    // Area over width is the height of the face across its other edge, in perspective.
    const area = Math.abs((side.x - at.x) * (top.y - at.y) - (side.y - at.y) * (top.x - at.x));
    const { text, marked } = this.labels[body]!;
    const room = (2 * halfWidth - (marked ? FRAME : 0)) / CHARACTER_WIDTH;
    // Without room for it the zero before the point is left out.
    const fitting = room / text.length < FONT.min ? text.replace(/^0(?=[.,])/, '') : text;
    const font = Math.floor(Math.min(FONT.max, (2 * FILL * area) / halfWidth, room / fitting.length));
    if (!(font >= FONT.min)) {
      this.cramped += 1;
      return;
    }
    if (span.textContent !== fitting) span.textContent = fitting;
    span.hidden = false;
    // Whole and even sizes, so that text and frame are rounded alike.
    span.style.fontSize = `${font}px`;
    span.style.lineHeight = `${2 * Math.ceil(0.55 * font)}px`;
    span.style.transform = `translate(${Math.round(at.x)}px, ${Math.round(at.y)}px) translate(-50%, -50%)`;
    this.shown += 1;
  }
}

/** Returns the face of a block that takes its label, or null. */
function labelledFace(bodies: Bodies, orbit: Orbit, body: number): Face | null {
  const face = visibleFace(bodies, orbit, body);
  if (!face) return null;
  const half = bodies.size(body).multiplyScalar(0.5);
  const edge = (k: number) => new Vector3().setComponent(k, half.getComponent(k));
  // Up is the vertical edge of an upright face, and the shorter edge of a level one.
  const others = [0, 1, 2].filter(k => k !== face.axis);
  const [across, up] = half.getComponent(others[0]) > half.getComponent(others[1]) ? others : [others[1], others[0]];
  return { middle: face.middle, across: edge(across), up: edge(up) };
}
