// The hand sets a block down by itself.

import { gestureOf, type GestureFactory } from './gesture';

export const placing: GestureFactory = () => ({
  name: 'placing',
  // A command that was refused leaves the block in the hand.
  update: hand => (hand.placing ? null : gestureOf(hand.grip)),
});
