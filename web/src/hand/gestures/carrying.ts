// A free block is carried; near a slot it is attracted, and released there it is placed.

import { Vector3 } from 'three';
import { sameSlot } from '../../engine/game-protocol';
import { SlotMagnet } from '../slot-magnet';
import { follow, gestureOf, letGo, move, shiftBy, type GestureFactory } from './gesture';

export const carrying: GestureFactory = (context, grasp) => {
  const magnet = new SlotMagnet();
  return {
    name: 'carrying',
    drag(by) {
      if (context.hand) follow(context, grasp, context.hand, by, magnet.slot);
      return null;
    },
    shift(displacement) {
      shiftBy(context, grasp, displacement, magnet.slot);
      return null;
    },
    release(tap) {
      if (tap || !magnet.slot) return letGo(context);
      grasp.command = context.send({ command: 'place', body: null, slot: magnet.slot });
      return 'placing';
    },
    update(hand, slots) {
      if (gestureOf(hand.grip) !== 'carrying') return 'sliding';
      const before = magnet.slot;
      const slot = magnet.seek(context.orbit, hand, slots);
      if (!sameSlot(slot, before)) move(context, new Vector3(), slot);
      return null;
    },
  };
};
