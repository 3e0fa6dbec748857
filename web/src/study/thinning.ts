// Fewer and coarser commands for a record that has to be short.

import type { GameCommand, Vec } from '../engine/game-protocol';

/** Parts of a metre of a displacement. */
const LENGTH = 1e4;
/** Change of the direction to the viewer that counts. */
const TURNED = 0.02;

type Move = Extract<GameCommand, { command: 'move' }>;

/**
 * Sums the displacements of `stride` frames into one, rounded to tenths of a millimetre with what
 * is left carried on; the sum of all stays the same. Commands stay in their frames otherwise.
 */
export function thinned(commands: readonly GameCommand[], stride: number): GameCommand[] {
  const result: GameCommand[] = [];
  let waiting: Move | null = null;
  let viewer: [number, number] | null = null;
  const flush = (): GameCommand => {
    if (!waiting) return { command: 'idle' };
    const displacement = waiting.displacement.map(x => Math.round(x * LENGTH) / LENGTH + 0) as Vec;
    const rest = waiting.displacement.map((x, k) => x - displacement[k]) as Vec;
    const toward_viewer = hasTurned(viewer, waiting.toward_viewer) ? waiting.toward_viewer : null;
    viewer = toward_viewer ?? viewer;
    const given: Move = { ...waiting, displacement, toward_viewer };
    waiting = { ...waiting, displacement: rest };
    return given;
  };
  let pending = 0;
  for (const command of commands) {
    if (command.command === 'move') {
      waiting = waiting ? sum(waiting, command) : command;
      pending += 1;
      const isDue = pending >= stride;
      if (isDue) pending = 0;
      result.push(isDue ? flush() : { command: 'idle' });
      continue;
    }
    // A change of the hand comes after the moves before it: the frame before is free for their sum.
    if (command.command !== 'idle' && pending > 0) result[result.length - 1] = flush();
    if (command.command !== 'idle') {
      pending = 0;
      if (command.command === 'grasp') [waiting, viewer] = [null, null];
    }
    result.push(command);
  }
  return result;
}

function sum(a: Move, b: Move): Move {
  return { ...b, displacement: a.displacement.map((x, k) => x + b.displacement[k]) as Vec };
}

function hasTurned(from: [number, number] | null, to: [number, number] | null): boolean {
  return to !== null && (from === null || Math.hypot(to[0] - from[0], to[1] - from[1]) > TURNED);
}
