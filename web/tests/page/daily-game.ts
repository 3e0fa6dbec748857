// A game on the tower of a day, played without a page.

import { Game } from '../../src/engine/game';
import { sceneText, type BuiltSource } from '../../src/engine/scene';
import { dailySetup } from '../../src/modes/daily';

/** Begins a game; `memory` is that of the engine, which is loaded. */
export function beginDaily(day: string, memory: WebAssembly.Memory): Game {
  const { source, sleep, rules, form, stiffness, springs } = dailySetup(day);
  const choice = { form: form!, stiffness: stiffness!, springs };
  return Game.begin(
    sceneText(source as BuiltSource, () => choice),
    sleep,
    rules,
    memory,
  );
}
