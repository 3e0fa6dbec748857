// A block has been grasped and hardly moved: a tap becomes a poke, a drag moves the block.

import { follow, gestureOf, letGo, moveAwayBy, type GestureFactory, type Transition } from './gesture';
import type { ScreenVector } from '../screen-to-world';

/** Displacement up to which a tap is a poke, m. */
const MAX_TAP = 0.004;
/** Vertical component of a face's normal up to which the face can be poked. */
const UPRIGHT = 0.5;

export const pressing: GestureFactory = (context, grasp) => {
  // The grip, which a drag depends on, is known once the grasp has been applied.
  let waiting: ScreenVector = { x: 0, y: 0 };

  function drag(by: ScreenVector): Transition {
    waiting = { x: waiting.x + by.x, y: waiting.y + by.y };
    const { hand } = context;
    if (!hand || (waiting.x === 0 && waiting.y === 0)) return null;
    follow(context, grasp, hand, waiting);
    waiting = { x: 0, y: 0 };
    return grasp.displacement.length() < MAX_TAP ? null : gestureOf(hand.grip);
  }

  return {
    name: 'pressing',
    drag,
    moveAway(distance) {
      if (context.hand?.grip !== 'carry') return null;
      moveAwayBy(context, grasp, distance);
      return 'carrying';
    },
    release(tap) {
      const upright = Math.abs(grasp.normal.z) < UPRIGHT;
      if (!tap || !upright || grasp.mode === 'carry') return letGo(context);
      grasp.command = context.send({ command: 'poke' });
      return 'poking';
    },
    update: () => drag({ x: 0, y: 0 }),
  };
};
