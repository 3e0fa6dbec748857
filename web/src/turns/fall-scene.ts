// The fall of the tower in slow motion, from another side.

import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';

/** Simulated time per wall time during a fall. */
const SPEED = 0.3;
/** Simulated time of the slow part, and until the game is over for the eye, s. */
const SLOW = 0.9;
const SHOWN = 2.5;
/** Turn of the camera, rad, and its distance over that of play. */
const TURN = 0.9;
const CLOSER = 0.85;

export class FallScene {
  private since: number | null = null;
  private ended = true;

  /** `over`: called once the fall has been seen. */
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    over: () => void,
  ) {
    store.subscribe(['world'], () => this.reset());
    store.subscribe(['frame'], ({ frame }) => {
      const turn = frame?.update.turn;
      if (!frame || !turn) return;
      const { time } = frame.update.report;
      const fell = frame.update.events.some(event => event.event === 'fell');
      const isOver = turn.phase === 'over';
      if (this.since === null && (fell || isOver)) this.begin(time, fell);
      if (this.since === null || this.ended || !isOver) return;
      if (time > this.since + SLOW && this.store.state.speed === SPEED) store.set({ speed: 1 });
      if (time > this.since + SHOWN) {
        this.ended = true;
        over();
      }
    });
  }

  private begin(time: number, fell: boolean): void {
    this.since = time;
    this.ended = false;
    if (!fell) {
      // Nothing to see: the game ended by the rules.
      this.since = time - SHOWN;
      return;
    }
    this.store.set({ speed: SPEED, selected: null });
    this.stage.orbit.turn(TURN, -0.15);
    this.stage.orbit.zoom(CLOSER);
  }

  private reset(): void {
    this.since = null;
    this.ended = true;
  }
}
