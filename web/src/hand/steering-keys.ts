// Keys of the hand: a game can be played with them alone. Enter chooses, takes and sets down a
// block; the arrows choose, pull, push and carry it.

import type { Hand } from './hand';
import type { Steer, Steering } from './steering';

/** Direction of each key on the screen, y down. */
const ARROWS: Record<string, { x: number; y: number }> = {
  ArrowLeft: { x: -1, y: 0 },
  ArrowRight: { x: 1, y: 0 },
  ArrowUp: { x: 0, y: -1 },
  ArrowDown: { x: 0, y: 1 },
};
/** Keys that move a block away from the viewer, and towards. */
const DEPTH: Record<string, number> = { PageUp: 1, PageDown: -1 };

export class SteeringKeys {
  private readonly down = new Set<string>();

  constructor(
    private readonly steering: Steering,
    private readonly hand: Hand,
  ) {
    window.addEventListener('keyup', event => this.down.delete(event.key));
    window.addEventListener('blur', () => this.down.clear());
  }

  /** Returns what a key does; nothing where it belongs to others. */
  action(key: string): (() => void) | undefined {
    const { steering, hand } = this;
    if (key === 'Enter') return () => this.enter();
    if (key === 't' && steering.active) return () => steering.poke();
    if (!steering.active || !(key in ARROWS || key in DEPTH)) return undefined;
    if (steering.holds) return () => this.down.add(key);
    return hand.holds || key in DEPTH ? undefined : () => steering.choose(ARROWS[key]);
  }

  /** Lets go of the block, or ends the choice. */
  escape(): void {
    if (!this.hand.holds) this.steering.end();
    this.hand.letGo();
  }

  /** Motion that the keys ask for while they are down. */
  get steer(): Steer {
    const steer: Steer = { right: 0, up: 0, away: 0 };
    for (const key of this.down) {
      steer.right += ARROWS[key]?.x ?? 0;
      steer.up -= ARROWS[key]?.y ?? 0;
      steer.away += DEPTH[key] ?? 0;
    }
    return steer;
  }

  private enter(): void {
    const { steering, hand } = this;
    this.down.clear();
    if (!steering.active) return steering.choose({ x: 0, y: 0 });
    if (!hand.holds) return void steering.take();
    if (hand.canPlace()) hand.place();
    else hand.letGo();
  }
}
