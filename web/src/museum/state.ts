// Fields of the state of the museum's tower.

import type { PlayState } from '../app/state';
import type { Store } from '../app/store';
import type { MuseumFrame, MuseumSetup } from './protocol';

export interface MuseumState extends PlayState<MuseumFrame> {
  setup: MuseumSetup;
  /** True for the hand of 2003, false for that of the game. */
  oldHand: boolean;
  /** True while the springs of the 2003 tower are drawn. */
  springs: boolean;
  /** True while the tower is on the screen. */
  onScreen: boolean;
}

export type MuseumStore = Store<MuseumState>;
