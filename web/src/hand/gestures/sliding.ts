// A block of the tower is pulled or pushed.

import { follow, gestureOf, letGo, shiftBy, type GestureFactory } from './gesture';

export const sliding: GestureFactory = (context, grasp) => ({
  name: 'sliding',
  drag(by) {
    if (context.hand) follow(context, grasp, context.hand, by);
    return null;
  },
  shift(displacement) {
    shiftBy(context, grasp, displacement);
    return null;
  },
  release: () => letGo(context),
  update: hand => (gestureOf(hand.grip) === 'sliding' ? null : 'carrying'),
});
