// Hatches the blocks that the rules protect, while a player chooses: a pattern, not a colour.

import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import type { TurnState } from '../engine/game-protocol';

export function markLegal(store: PageStore, stage: Stage): void {
  let shown = '';
  store.subscribe(['world'], () => (shown = ''));
  store.subscribe(['frame'], ({ frame }) => {
    const count = stage.bodies?.count ?? 0;
    const blocks = protectedBlocks(frame?.update.turn, count);
    const next = [...blocks].join();
    if (next === shown) return;
    shown = next;
    stage.view.hatch(blocks);
  });
}

/** Returns the blocks of `count` that may not be touched by a player who chooses. */
export function protectedBlocks(turn: TurnState | undefined, count: number): Set<number> {
  if (turn?.phase !== 'choosing') return new Set();
  const all = new Set(Array.from({ length: count }, (_, body) => body));
  for (const body of turn.removable) all.delete(body);
  return all;
}
