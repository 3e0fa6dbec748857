// Figures on blocks: one on the end of each that is seen, or on another face where no end is. They are text over the picture, as sharp as the
// screen is, and never larger than their face.

import { Vector3 } from 'three';
import type { Bodies } from './bodies';
import { pick } from './boxes';
import type { Orbit } from './orbit';

/** What is written on a block. */
export interface Label {
  text: string;
  /** Colour of the block under it, so that the figures are light or dark. */
  dark: boolean;
  /** Whether it is to be seen first. */
  marked: boolean;
}

/** Sizes of the figures, px. */
const FONT = { least: 8, most: 13 };
/** Height of the figures over that of their face, and width of one over its height. */
const FILL = 0.68;
const WIDE = 0.64;
/** Width of the frame of a marked label, px. */
const FRAME = 5;
/** Part of the way from a face's middle to the eye by which a face must look at it. */
const FACING = 0.12;
/** Distance from a face at which a ray from the eye has come to it, m. */
const AT_FACE = 0.002;
/** Time between two looks at which faces are seen, s: places on the screen follow in every picture. */
const LOOK = 0.1;

/** Faces by preference: ends, which are seen while a block is in the tower, then the others. */
const FACES: [axis: 0 | 1 | 2, side: 1 | -1][] = [
  [0, 1],
  [0, -1],
  [1, 1],
  [1, -1],
  [2, 1],
  [2, -1],
];

interface Place {
  /** Middle of the face in the block as it was made, m. */
  middle: Vector3;
  /** Half of the edges across and up, m. */
  across: Vector3;
  up: Vector3;
}

export class Labels {
  private readonly element = document.getElementById('labels')!;
  private spans: HTMLSpanElement[] = [];
  private labels: (Label | null)[] = [];
  private places: (Place | null)[] = [];
  private lookedAt = 0;
  private stale = false;
  /** Number of figures that are seen, */
  shown = 0;
  /** and of those for which their face is too small on the screen. */
  cramped = 0;

  /** Writes a label on each block, none on those where it is null; null takes all away. */
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
    this.places = [];
    this.stale = true;
    this.lookedAt = 0;
  }

  /** Puts the labels where their blocks are, at a wall time (s). `moved`: blocks or camera have moved. */
  follow(
    bodies: Bodies,
    orbit: Orbit,
    { width, height }: { width: number; height: number },
    moved: boolean,
    now: number,
  ): void {
    if (this.labels.length !== bodies.count) return;
    if (moved) this.stale = true;
    if (!this.stale) return;
    if (now - this.lookedAt > LOOK) {
      this.lookedAt = now;
      this.stale = false;
      this.places = this.labels.map((label, body) => (label ? look(bodies, orbit, body) : null));
    }
    this.shown = this.cramped = 0;
    this.places.forEach((place, body) => this.put(place, body, bodies, orbit, width, height));
  }

  private put(place: Place | null, body: number, bodies: Bodies, orbit: Orbit, width: number, height: number): void {
    const span = this.spans[body];
    span.hidden = true;
    if (!place) return;
    const project = (point: Vector3) => orbit.project(bodies.surface(body, point), width, height);
    const at = project(place.middle);
    const [side, top] = [place.across, place.up].map(half => project(place.middle.clone().add(half)));
    const wide = Math.hypot(side.x - at.x, side.y - at.y);
    // Height of the face as it shows: across its other edge.
    const area = Math.abs((side.x - at.x) * (top.y - at.y) - (side.y - at.y) * (top.x - at.x));
    const { text, marked } = this.labels[body]!;
    const room = (2 * wide - (marked ? FRAME : 0)) / WIDE;
    // Where there is no room for it the nought before the point is left out.
    const fitting = room / text.length < FONT.least ? text.replace(/^0\./, '.') : text;
    const font = Math.floor(Math.min(FONT.most, (2 * FILL * area) / wide, room / fitting.length));
    if (!(font >= FONT.least)) {
      this.cramped += 1;
      return;
    }
    if (span.textContent !== fitting) span.textContent = fitting;
    span.hidden = false;
    // Whole and even sizes: text and frame are rounded alike.
    span.style.fontSize = `${font}px`;
    span.style.lineHeight = `${2 * Math.ceil(0.55 * font)}px`;
    span.style.transform = `translate(${Math.round(at.x)}px, ${Math.round(at.y)}px) translate(-50%, -50%)`;
    this.shown += 1;
  }
}

/** The first face that is seen, or none. */
function look(bodies: Bodies, orbit: Orbit, body: number): Place | null {
  const eye = orbit.camera.position;
  const half = bodies.size(body).multiplyScalar(0.5);
  for (const [axis, side] of FACES) {
    const edge = (k: number) => new Vector3().setComponent(k, half.getComponent(k));
    const middle = edge(axis).multiplyScalar(side);
    const point = bodies.surface(body, middle);
    const way = point.clone().sub(eye);
    const distance = way.length();
    way.divideScalar(distance);
    const normal = new Vector3().setComponent(axis, side).applyQuaternion(bodies.turn(body));
    if (normal.dot(way) > -FACING) continue;
    const hit = pick(bodies, eye, way);
    if (hit?.body !== body || Math.abs(hit.distance - distance) > AT_FACE) continue;
    // Of an upright face the vertical edge is up; of one that lies, the shorter.
    const others = [0, 1, 2].filter(k => k !== axis);
    const [across, up] = half.getComponent(others[0]) > half.getComponent(others[1]) ? others : [others[1], others[0]];
    return { middle, across: edge(across), up: edge(up) };
  }
  return null;
}
