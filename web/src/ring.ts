// The force of the hand, drawn where it grasps: length of the arc, a number, and dashes with a word when it can give no more.

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

export class Ring {
  private readonly group = element('ring-group');
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

function element(id: string): SVGElement {
  return document.getElementById(id) as unknown as SVGElement;
}

function set(node: SVGElement, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}
