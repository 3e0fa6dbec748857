// The force of the hand, drawn where it grasps: length of the arc, a number, and dashes with a word when it can give no more.

import { Vector3 } from 'three';
import type { Bodies } from './bodies';
import type { Hand } from './hand';
import type { Orbit } from './orbit';
import type { HandState } from './protocol';

export interface RingState {
  /** Screen position of the grasped point, CSS px. */
  at: { x: number; y: number };
  /** Where the arrow of the force ends, relative to it, CSS px. */
  arrow: { x: number; y: number };
  /** N. */
  force: number;
  /** N. */
  cap: number;
  capped: boolean;
  note: string;
}

const RADIUS = 24;
/** Length of the force's arrow, px/N. */
const ARROW = 22;

/** What the element `ring` of a page is filled with. */
const PICTURE = `
  <g id="ring-group" visibility="hidden">
    <line id="ring-arrow" x1="0" y1="0" x2="0" y2="0" marker-end="url(#ring-head)" />
    <circle id="ring-track" r="${RADIUS}" />
    <circle id="ring-arc" r="${RADIUS}" pathLength="100" transform="rotate(-90)" />
    <circle id="ring-dot" r="2.5" />
    <text id="ring-force" y="44"></text>
    <text id="ring-note" y="61"></text>
  </g>
  <defs>
    <marker id="ring-head" viewBox="0 0 8 8" refX="5" refY="4" markerWidth="5" markerHeight="5" orient="auto-start-reverse">
      <path d="M0 0 8 4 0 8z" />
    </marker>
  </defs>`;

export class Ring {
  private readonly group = drawn();
  private readonly arc = element('ring-arc');
  private readonly arrow = element('ring-arrow');
  private readonly force = element('ring-force');
  private readonly note = element('ring-note');

  show(state: RingState | null): void {
    this.group.setAttribute('visibility', state ? 'visible' : 'hidden');
    if (!state) return;
    this.group.setAttribute('transform', `translate(${state.at.x.toFixed(1)} ${state.at.y.toFixed(1)})`);
    this.group.classList.toggle('capped', state.capped);
    const part = Math.min(100, (100 * state.force) / state.cap);
    this.arc.setAttribute('stroke-dasharray', `${part.toFixed(1)} 100`);
    // The arrow starts at the rim; a force too small to see has none.
    const length = Math.hypot(state.arrow.x, state.arrow.y);
    const visible = length > 3;
    this.arrow.setAttribute('visibility', visible ? 'inherit' : 'hidden');
    if (visible) {
      const unit = { x: state.arrow.x / length, y: state.arrow.y / length };
      this.arrow.setAttribute('x1', (unit.x * RADIUS).toFixed(1));
      this.arrow.setAttribute('y1', (unit.y * RADIUS).toFixed(1));
      this.arrow.setAttribute('x2', (unit.x * (RADIUS + length)).toFixed(1));
      this.arrow.setAttribute('y2', (unit.y * (RADIUS + length)).toFixed(1));
    }
    set(this.force, `${state.force.toFixed(2)} N${state.capped ? ' · most' : ''}`);
    set(this.note, state.note);
  }
}

/** What the ring shows of a hand that holds or pokes a block, from what was last `told` of it; `canvas` is what the picture fills. */
export function ringOf(
  hand: Hand,
  told: HandState | null,
  bodies: Bodies,
  orbit: Orbit,
  canvas: HTMLElement,
): RingState | null {
  const hold = hand.hold;
  if (!told || (!hold && hand.poking === null)) return null;
  const { clientWidth: width, clientHeight: height } = canvas;
  const point = hold ? bodies.toWorld(hold.body, hold.anchor) : new Vector3(...told.point);
  const force = new Vector3(...told.force);
  // A sliding hand bears the block's weight besides; the arrow is for what it pulls.
  const pull = told.grip === 'slide' ? force.clone().setZ(0) : force;
  const at = orbit.project(point, width, height);
  const scale = orbit.scaleAt(point, height);
  const step = 0.004;
  const tip = orbit.project(
    point.clone().addScaledVector(pull.clone().normalize(), pull.length() > 1e-6 ? step : 0),
    width,
    height,
  );
  const reach = (ARROW * pull.length()) / (scale * step);
  const stuck = hand.holders();
  return {
    at,
    arrow: { x: (tip.x - at.x) * reach, y: (tip.y - at.y) * reach },
    force: force.length(),
    cap: hand.cap,
    capped: hold?.capped ?? false,
    note: stuck ? heldBy(stuck) : '',
  };
}

/** What holds a block, in words. */
export function heldBy({ bodies, force }: { bodies: number[]; force: number }): string {
  if (bodies.length === 0) return '';
  return `held by ${bodies.length === 1 ? '1 block' : `${bodies.length} blocks`}, ${force.toFixed(1)} N`;
}

/** Draws the ring, hidden, and gives what moves with the hand. */
function drawn(): SVGElement {
  element('ring').innerHTML = PICTURE;
  return element('ring-group');
}

function element(id: string): SVGElement {
  return document.getElementById(id) as unknown as SVGElement;
}

function set(node: SVGElement, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}
