// The beginning of a record beside that of a game that could be played here.

import { Game } from '../engine/game';
import type { Setup } from '../engine/protocol';
import { sceneText } from '../engine/scene';
import { Keyframes } from '../wasm/teeter_wasm.js';

/** True if a record begins as the games of a setup: on the same blocks, by the same rules. */
export function beginsAs(record: Uint8Array, setup: Setup, memory: WebAssembly.Memory): boolean {
  const { source, form, stiffness, springs, sleep, rules } = setup;
  const found = new Keyframes(record);
  // Most records are of other rules, and their towers need not be compared.
  const isOther = (JSON.parse(found.rules()) as { table: string }).table !== rules?.table;
  if (isOther || form === null || stiffness === null || 'bytes' in source) {
    found.free();
    return false;
  }
  const game = Game.begin(
    sceneText(source, () => ({ form, stiffness, springs })),
    sleep,
    rules,
    memory,
  );
  const expected = new Keyframes(game.record(false)!.bytes);
  game.free();
  const isSame = found.scene() === expected.scene() && found.rules() === expected.rules();
  [found, expected].forEach(keyframes => keyframes.free());
  return isSame;
}
