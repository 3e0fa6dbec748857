// A block has been grasped and hardly moved: a tap becomes a poke, a drag moves the block.

import { follow, gestureOf, letGo, shiftBy, type GestureFactory, type Transition } from './gesture';
import type { ScreenVector } from '../screen-to-world';

/** Displacement from which the block is moved, m: the game pokes none that has gone so far. */
const MOVED = 0.004;

export const pressing: GestureFactory = (context, grasp) => {
  // The grip, which a drag depends on, is known once the grasp has been applied.
  let waiting: ScreenVector = { x: 0, y: 0 };

  function drag(by: ScreenVector): Transition {
    waiting = { x: waiting.x + by.x, y: waiting.y + by.y };
    const { hand } = context;
    if (!hand || (waiting.x === 0 && waiting.y === 0)) return null;
    follow(context, grasp, hand, waiting);
    waiting = { x: 0, y: 0 };
    return grasp.displacement.length() < MOVED ? null : gestureOf(hand.grip);
  }

  return {
    name: 'pressing',
    drag,
    shift(displacement) {
      if (!context.hand) return null;
      shiftBy(context, grasp, displacement);
      return grasp.displacement.length() < MOVED ? null : gestureOf(context.hand.grip);
    },
    release(tap) {
      if (!tap) return letGo(context);
      grasp.command = context.send({ command: 'poke' });
      return 'poking';
    },
    update: () => drag({ x: 0, y: 0 }),
  };
};
