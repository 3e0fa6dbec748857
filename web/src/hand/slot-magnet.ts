// Chooses the slot that attracts a carried block: the nearest one on the screen, with hysteresis.

import { Quaternion, Vector3 } from 'three';
import { sameSlot, type HandUpdate, type Slot, type SlotId } from '../engine/game-protocol';
import type { Orbit } from '../view/orbit';

/**
 * Distance at which a slot attracts the block: in m at the slot's depth, and at least so many px.
 */
const REACH = { metres: 0.03, pixels: 22 };
/** Factor on the distance for the current slot. */
const HYSTERESIS = 1.5;
/** Distance over the reach from which a block counts as taken out of the slot it was in. */
const LEFT = 1.3;

export class SlotMagnet {
  slot: SlotId | null = null;
  /** False until the block has left the slot it was in. */
  private armed = false;

  /** Chooses the slot for the held block. */
  seek(orbit: Orbit, hand: HandUpdate, slots: Slot[]): SlotId | null {
    const centre = new Vector3(...hand.goal);
    if (hand.orientation) centre.sub(new Vector3(...hand.anchor).applyQuaternion(new Quaternion(...hand.orientation)));
    const here = orbit.project(centre);
    let best: SlotId | null = null;
    let min = Infinity;
    for (const slot of slots) {
      const position = new Vector3(...slot.position);
      const there = orbit.project(position);
      const reach = Math.max(REACH.metres * orbit.scaleAt(position), REACH.pixels);
      const factor = sameSlot(slot, this.slot) ? HYSTERESIS : 1;
      const distance = Math.hypot(there.x - here.x, there.y - here.y) / (reach * factor);
      if (distance < min) {
        min = distance;
        best = { row: slot.row, cell: slot.cell };
      }
    }
    if (min > LEFT) this.armed = true;
    this.slot = this.armed && min < 1 ? best : null;
    return this.slot;
  }
}
