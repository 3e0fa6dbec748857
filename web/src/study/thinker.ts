// Answers the questions of computer players: several workers make rollouts with seeds of their own,
// and what they saw is put together.

import type { Deliberation } from '../engine/protocol';
import type { Considered } from './jobs';
import type { Pool } from './pool';

/** Longest time of a thought, s, so that its move begins within two. */
const SECONDS = 1.6;

export class Thinker {
  /** `progress`: takes the part of the thought that is done; 1 at its end. */
  constructor(
    private readonly pool: Pool,
    private readonly progress: (part: number) => void,
  ) {}

  /** Returns the moves that were considered, the chosen one first. */
  async answer({ state, question }: Deliberation): Promise<Considered[]> {
    this.progress(0);
    const jobs = Array.from({ length: this.pool.size }, (_, k) => {
      const job = { kind: 'think', seconds: SECONDS, state, question: reseeded(question, k) } as const;
      return this.pool.run(job, k === 0 ? part => this.progress(part) : undefined).result;
    });
    const answers = await Promise.allSettled(jobs);
    this.progress(1);
    return merged(answers.flatMap(answer => (answer.status === 'fulfilled' ? answer.value : [])));
  }
}

/** Adds to the seed of a question, which has 64 bits: more than a number of JavaScript holds. */
export function reseeded(question: string, offset: number): string {
  return question.replace(/("seed":)(\d+)/, (_, key: string, seed: string) => {
    return key + BigInt.asUintN(64, BigInt(seed) + BigInt(offset)).toString();
  });
}

/** Puts the rollouts of the same block together; the move with the smallest cost comes first. */
export function merged(moves: readonly Considered[]): Considered[] {
  const byBody = new Map<number, Considered>();
  for (const move of moves) {
    const other = byBody.get(move.body);
    byBody.set(move.body, other ? weighted(other, move) : move);
  }
  return [...byBody.values()].sort((a, b) => a.cost - b.cost);
}

function weighted(a: Considered, b: Considered): Considered {
  const rollouts = a.rollouts + b.rollouts;
  // Without rollouts the two are the same.
  const part = rollouts > 0 ? b.rollouts / rollouts : 0;
  const mean = (x: number, y: number) => x + part * (y - x);
  return {
    ...a,
    rollouts,
    cost: mean(a.cost, b.cost),
    chance_of_fall: mean(a.chance_of_fall, b.chance_of_fall),
    low: mean(a.low, b.low),
    high: mean(a.high, b.high),
  };
}
