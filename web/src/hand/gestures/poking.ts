// A fingertip pushes a block in by a few millimetres.

import { gestureOf, type GestureFactory } from './gesture';

export const poking: GestureFactory = () => ({
  name: 'poking',
  // A command that was refused leaves the block in the hand.
  update: hand => (hand.poking ? null : gestureOf(hand.grip)),
});
