// Rounds the numbers of commands as records store them in the fewest bytes: lengths to hundredths
// of a millimetre, directions and rotations to four decimals. The game takes the rounded command,
// so its record holds what was played.

import type { GameCommand } from './game-protocol';

/** Parts of a metre, and of a unit vector. */
const LENGTH = 1e5;
const DIRECTION = 1e4;

function toParts<T extends readonly number[]>(vector: T, parts: number): T {
  // The sum turns a negative zero into zero.
  return vector.map(x => Math.round(x * parts) / parts + 0) as unknown as T;
}

export function rounded(command: GameCommand): GameCommand {
  switch (command.command) {
    case 'grasp':
      return {
        ...command,
        anchor: toParts(command.anchor, LENGTH),
        normal: toParts(command.normal, DIRECTION),
      };
    case 'move': {
      const { displacement, toward_viewer } = command;
      return {
        ...command,
        displacement: toParts(displacement, LENGTH),
        toward_viewer: toward_viewer && toParts(toward_viewer, DIRECTION),
      };
    }
    case 'turn':
      return { ...command, rotation: toParts(command.rotation, DIRECTION) };
    default:
      return command;
  }
}
