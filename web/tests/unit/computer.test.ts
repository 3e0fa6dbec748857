import { readFile } from 'node:fs/promises';
import { expect, test } from 'vitest';
import { Game } from '../../src/engine/game';
import load, { towerScene } from '../../src/wasm/teeter_wasm.js';

test('a game that goes on in the turn of the computer does not wait for its thought', async () => {
  const module_or_path = await readFile(new URL('../../src/wasm/teeter_wasm_bg.wasm', import.meta.url));
  const { memory } = await load({ module_or_path });
  const begun = Game.begin(towerScene('{"rows": 4}'), true, { table: 'official', players: 2 }, memory);
  for (let frame = 0; frame < 60; frame++) begun.step({ command: 'idle' });
  const game = Game.resume(begun.record(true)!.bytes, memory);
  game.seat([{ player: 0, strength: 'random', seed: 1 }]);
  expect(game.computerCommand(), 'before its question is asked').toBeNull();
  expect(game.question()).toMatchObject({ player: 0 });
  expect(game.computerCommand(), 'while it thinks').toBeNull();
});
