// Hints: the safest block, by pulls that are tried on copies of the tower in a worker.

import type { Play } from '../app/play';
import type { PageStore } from '../app/state';
import { games } from '../messages';
import type { Notice } from '../ui/notice';

/** Simulated time of all trials, and longest time for them, s. */
const BUDGET = 400;
const SECONDS = 5;

export class Hints {
  private running = false;

  constructor(
    private readonly store: PageStore,
    private readonly play: Play,
    private readonly notice: Notice,
  ) {}

  /** Selects the safest block. */
  async show(): Promise<void> {
    const { hints } = games;
    const { frame, world, watching } = this.store.state;
    const turn = frame?.update.turn;
    if (this.running || watching || !world || turn?.phase !== 'choosing') return;
    if (!frame!.update.at_rest) return this.notice.show(hints.moving);
    this.running = true;
    this.notice.hold(hints.working);
    try {
      const state = await this.play.client.ask({ what: 'world' });
      const rules = JSON.stringify(world.rules);
      const job = { kind: 'tower', state, rules, budget: BUDGET, seconds: SECONDS } as const;
      const blocks = await this.play.pool.run(job).result;
      const legal = blocks.filter(({ body, rollouts }) => turn.removable.includes(body) && rollouts > 0);
      legal.sort((a, b) => a.chance_of_fall + a.chance_stuck - b.chance_of_fall - b.chance_stuck || a.high - b.high);
      this.notice.release(hints.working);
      if (legal.length === 0 || this.store.state.world !== world) return;
      const percent = Math.round(100 * legal[0].chance_of_fall);
      this.store.set({ selected: legal[0].body, safest: { body: legal[0].body, chance: legal[0].chance_of_fall } });
      this.notice.show(hints.safest(percent), 6);
    } catch (error) {
      this.notice.show((error as Error).message);
    } finally {
      this.running = false;
    }
  }
}
