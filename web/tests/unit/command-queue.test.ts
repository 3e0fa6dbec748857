// Commands are applied one a frame and in order; those that add up are merged.

import { expect, test } from 'vitest';
import { CommandQueue } from '../../src/engine/command-queue';
import type { GameCommand } from '../../src/engine/game-protocol';

const move = (x: number): GameCommand => ({
  command: 'move',
  displacement: [x, 0, 0],
  slot: null,
  toward_viewer: null,
});

test('displacements that follow each other add up to one command, which carries the last number', () => {
  const queue = new CommandQueue();
  queue.add(1, move(1));
  queue.add(2, move(2));
  expect(queue.next()).toEqual(move(3));
  expect(queue.applied).toBe(2);
  expect(queue.next()).toEqual({ command: 'idle' });
});

test('a release between two displacements keeps them apart', () => {
  const queue = new CommandQueue();
  queue.add(1, move(1));
  queue.add(2, { command: 'release' });
  queue.add(3, move(2));
  expect([queue.next(), queue.next(), queue.next()]).toEqual([move(1), { command: 'release' }, move(2)]);
});

test('settings of the hand are merged, the later ones winning', () => {
  const queue = new CommandQueue();
  queue.add(1, { command: 'set_hand', max_force: 4, careful: true });
  queue.add(2, { command: 'set_hand', careful: false });
  expect(queue.next()).toEqual({ command: 'set_hand', max_force: 4, careful: false });
});
