// The force of the hand, drawn at the grasped point: an arc, a number and an arrow, and dashes and
// words at the limit.

import { Vector3 } from 'three';
import type { HandUpdate } from '../engine/game-protocol';
import type { Hand, Holders } from '../hand/hand';
import { text } from '../messages';
import type { Bodies } from '../view/bodies';
import type { Orbit } from '../view/orbit';
import { element, setText } from './dom';

export interface RingState {
  /** Screen position of the grasped point, CSS px. */
  at: { x: number; y: number };
  /** Tip of the force's arrow relative to it, CSS px. */
  arrow: { x: number; y: number };
  /** N. */
  force: number;
  /** N. */
  maxForce: number;
  capped: boolean;
  note: string;
}

const RADIUS = 24;
/** Length of the force's arrow, px/N. */
const ARROW = 22;
/** Length over which the direction of the force is projected, m. */
const STEP = 0.004;

/** Content of the element `ring`. */
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

export class ForceRing {
  private readonly group = createRing();
  private readonly arc = element<SVGElement>('ring-arc');
  private readonly arrow = element<SVGElement>('ring-arrow');
  private readonly force = element<SVGElement>('ring-force');
  private readonly note = element<SVGElement>('ring-note');

  show(state: RingState | null): void {
    this.group.setAttribute('visibility', state ? 'visible' : 'hidden');
    if (!state) return;
    this.group.setAttribute('transform', `translate(${state.at.x.toFixed(1)} ${state.at.y.toFixed(1)})`);
    this.group.classList.toggle('capped', state.capped);
    const part = Math.min(100, (100 * state.force) / state.maxForce);
    this.arc.setAttribute('stroke-dasharray', `${part.toFixed(1)} 100`);
    // The arrow starts at the rim; a force too small to be visible has none.
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
    const force = text.readouts.newtons(state.force, 2);
    setText(this.force, state.capped ? text.hand.limit(force) : force);
    setText(this.note, state.note);
  }
}

/** Returns the ring for a hand that holds or pokes a block, else null. */
export function ringState(hand: Hand, maxForce: number, bodies: Bodies, orbit: Orbit): RingState | null {
  const { held } = hand;
  if (!held) return null;
  const point = bodies.toWorld(held.body, new Vector3(...held.anchor));
  const pull = pullOf(held);
  const at = orbit.project(point);
  const ahead = point.clone().addScaledVector(pull.clone().normalize(), pull.length() > 1e-6 ? STEP : 0);
  const tip = orbit.project(ahead);
  const reach = (ARROW * pull.length()) / (orbit.scaleAt(point) * STEP);
  const holders = hand.holders();
  return {
    at,
    arrow: { x: (tip.x - at.x) * reach, y: (tip.y - at.y) * reach },
    force: new Vector3(...held.force).length(),
    maxForce,
    capped: held.capped && !held.poking,
    note: holders ? heldBy(holders) : '',
  };
}

/** A sliding hand also carries part of the block's weight; the arrow shows what it pulls with. */
function pullOf({ grip, force }: HandUpdate): Vector3 {
  const pull = new Vector3(...force);
  return grip === 'slide' ? pull.setZ(0) : pull;
}

/** Describes the blocks that hold a block. */
export function heldBy({ bodies, force }: Holders): string {
  if (bodies.length === 0) return '';
  return text.hand.heldBy(bodies.length, text.readouts.newtons(force, 1));
}

/** Creates the ring, hidden, and returns the group that moves with the hand. */
function createRing(): SVGElement {
  element('ring').innerHTML = PICTURE;
  return element<SVGElement>('ring-group');
}
