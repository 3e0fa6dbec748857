// The best game on the tower of the day: named at the start, and shown as a ghost.

import type { Play } from '../app/play';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import { POSE_STRIDE } from '../engine/game-protocol';
import type { Built } from '../engine/protocol';
import { games } from '../messages';
import type { Notice } from '../ui/notice';
import { Bodies } from '../view/bodies';
import { Ghost } from '../view/ghost';
import type { DailyRanking, Ranked } from './daily-ranking';

/** Distance for the opacity of the ghost, m. */
const FAINT = 0.0012;
/** Displacement from which a block is part of the ghost, m: more than a tower leans. */
const MOVED = 0.01;

export class DailyBest {
  private readonly ghost = new Ghost();
  /** Poses of the ghost; null where none is shown. */
  shown: Float32Array | null = null;
  /** Poses at the end of the last turn in which the tower stood, and its height, m. */
  private stood: { poses: Float32Array; height: number } | null = null;

  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly play: Play,
    private readonly ranking: DailyRanking,
    private readonly notice: Notice,
  ) {
    stage.view.add(this.ghost.group);
    store.subscribe(['dark'], ({ dark }) => this.ghost.setDark(dark));
    store.subscribe(['world'], () => void this.begin());
    store.subscribe(['frame'], ({ frame }) => {
      if (!this.isPlayed || !frame?.update.events.some(({ event }) => event === 'settled')) return;
      this.stood = { poses: frame.poses.slice(), height: stage.bodies!.top() };
    });
  }

  /** Stores the game where it is the best of the day. */
  async finish(): Promise<void> {
    const turn = this.store.state.frame?.update.turn;
    const { stood } = this;
    if (!this.isPlayed || !turn || !stood) return;
    const record = await this.play.client.ask({ what: 'record', state: false });
    if (!record) return;
    await this.ranking
      .finish({ points: turn.scores[0], ...stood, record: record.bytes })
      .catch(() => this.notice.show(games.records.notKept));
  }

  /** Shows the ghost of the best game, and returns that; null where none is shown. */
  async show(): Promise<Ranked | null> {
    const { world } = this.store.state;
    const [best] = await this.ranking.list();
    if (!this.isPlayed || !world || world.frames !== null || this.store.state.world !== world) return null;
    if (best?.poses.length !== world.poses.length) return null;
    const bodies = moved(world, best.poses);
    if (bodies.count > 0) this.ghost.show(bodies, new Float32Array(bodies.count).fill(FAINT));
    this.stage.view.invalidate();
    this.shown = best.poses;
    return best;
  }

  private get isPlayed(): boolean {
    return this.store.state.match.mode === 'daily';
  }

  private async begin(): Promise<void> {
    this.stood = null;
    this.ghost.hide();
    this.shown = null;
    this.stage.view.invalidate();
    const { world } = this.store.state;
    if (!this.isPlayed || !world || world.frames !== null) return;
    const best = await this.show();
    if (this.store.state.world === world) this.notice.show(lineOf(best), 6);
  }
}

/** Blocks that are not where they are at the start: the others would cover the tower. */
function moved({ sizes, poses: start }: Built, poses: Float32Array): Bodies {
  const bodies = Array.from({ length: sizes.length / 3 }, (_, body) => body);
  const by = (body: number) =>
    Math.hypot(...[0, 1, 2].map(k => poses[POSE_STRIDE * body + k] - start[POSE_STRIDE * body + k]));
  const chosen = bodies.filter(body => by(body) > MOVED);
  const part = (numbers: Float32Array, stride: number) =>
    Float32Array.from(chosen.flatMap(body => [...numbers.subarray(stride * body, stride * (body + 1))]));
  return new Bodies(part(sizes, 3), part(poses, POSE_STRIDE));
}

/** Line about the best game of the day. */
function lineOf(best: Ranked | null): string {
  if (!best) return games.daily.first;
  const height = Math.round(best.height * 1000);
  return best.name === null
    ? games.daily.best(best.points, height)
    : games.daily.bestOf(best.name, best.points, height);
}
