// Standing, moving, fallen: told from poses, and what the player does with a block in the hand is no fall.

import { expect, test } from 'vitest';
import { Verdict } from '../../src/verdict';
import { tower } from './towers';

test('a block that comes down by itself has fallen, and stays fallen', () => {
  const bodies = tower(['xxx', 'xxx']);
  const verdict = new Verdict(bodies.newest);
  expect(verdict.judge(bodies.newest, 0, 0, null)).toBe('standing');
  expect(verdict.judge(bodies.newest, 0.1, 0.02, null)).toBe('moving');
  const down = bodies.newest.slice();
  down[5 * 7 + 2] -= 0.004;
  expect(verdict.judge(down, 0.2, 0, null)).toBe('standing');
  down[5 * 7 + 2] -= 0.002;
  expect(verdict.judge(down, 0.3, 0.1, null)).toBe('fallen');
  expect(verdict.judge(bodies.newest, 0.4, 0, null)).toBe('fallen');
  expect(verdict.count).toBe(1);
});

test('a block put on the table by the hand is no fall, others that fall with it are', () => {
  const bodies = tower(['xxx', 'xxx']);
  const verdict = new Verdict(bodies.newest);
  const poses = bodies.newest.slice();
  verdict.judge(poses, 1, 0.1, 4);
  poses[4 * 7 + 2] = 0.009;
  expect(verdict.judge(poses, 1.5, 0.1, null)).toBe('moving');
  expect(verdict.judge(poses, 4, 0, null)).toBe('standing');
  poses[3 * 7 + 2] = 0.009;
  expect(verdict.judge(poses, 4.1, 0, null)).toBe('fallen');
});
