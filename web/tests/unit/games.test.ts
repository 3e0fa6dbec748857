import { expect, test } from 'vitest';
import type { GameCommand, TurnState } from '../../src/engine/game-protocol';
import { rounded } from '../../src/engine/command-rounding';
import { dailySettings, dayOf } from '../../src/modes/daily';
import { after, computersOf, matchOf, person, rulesOf } from '../../src/modes/match';
import { fromText, linkOf, recordIn, toText } from '../../src/records/link';
import type { Considered } from '../../src/study/jobs';
import { thinned } from '../../src/study/thinning';
import { merged, reseeded } from '../../src/study/thinker';
import { protectedBlocks } from '../../src/turns/legal-marks';

test('a link holds a record of any bytes, and text that is none holds no record', () => {
  for (let length = 0; length < 70; length++) {
    const record = Uint8Array.from({ length }, (_, k) => (k * 89 + length * 31) % 256);
    expect(fromText(toText(record))).toEqual(record);
    if (length > 0) expect(recordIn(new URL(linkOf(record, 'https://host/page/?rows=6#old')).hash)).toEqual(record);
  }
  expect(linkOf(new Uint8Array([255, 254]), 'https://host/page/?rows=6')).toBe('https://host/page/#move=__4');
  for (const hash of ['', '#', '#other=AA', '#move=', '#move=a b', '#move=%2B', '#move=A'])
    expect(recordIn(hash), hash).toBeNull();
});

test('the rollouts of several workers are put together by block, and the smallest cost wins', () => {
  const move = (body: number, rollouts: number, chance_of_fall: number): Considered => ({
    body,
    toward: [1, 0, 0],
    rollouts,
    chance_of_fall,
    low: 0,
    high: 1,
    cost: chance_of_fall,
  });
  const moves = merged([move(3, 4, 0.5), move(7, 4, 0.25), move(3, 12, 0.1)]);
  expect(moves.map(({ body, rollouts }) => [body, rollouts])).toEqual([
    [3, 16],
    [7, 4],
  ]);
  expect(moves[0].cost).toBeCloseTo(0.2, 12);
  // Without rollouts the order of the first worker stays.
  expect(merged([move(5, 0, 0.5), move(2, 0, 0.5), move(5, 0, 0.5)]).map(({ body }) => body)).toEqual([5, 2]);
});

test('a seed of 64 bits keeps all of them when it grows', () => {
  const question = '{"bodies":[1],"seed":18446744073709551615,"x":2}';
  expect(reseeded(question, 0)).toBe(question);
  expect(reseeded(question, 3)).toBe('{"bodies":[1],"seed":2,"x":2}');
});

test('blocks are hatched only while a player chooses, and only those that may not be touched', () => {
  const turn = { phase: 'choosing', removable: [0, 2] } as unknown as TurnState;
  expect([...protectedBlocks(turn, 4)]).toEqual([1, 3]);
  for (const phase of ['removing', 'placing', 'settling', 'over'] as const)
    expect(protectedBlocks({ ...turn, phase }, 4).size).toBe(0);
  expect(protectedBlocks(undefined, 4).size).toBe(0);
});

test('a match counts wins, and the loser begins the next game', () => {
  const match = matchOf('hot-seat', 'official', [person('Anna'), person('Ben')]);
  const next = after(match, 0, 1);
  expect(next.wins).toEqual([1, 0]);
  expect(rulesOf(next, 5)).toEqual({ table: 'official', players: 2, first: 1 });
  expect(rulesOf({ ...match, table: 'throw-and-go' }, 5)).toMatchObject({ die: 5 });
  expect(rulesOf(matchOf('free', 'free', [person('')]), 5)).toBeNull();
  expect(after(matchOf('solo', 'solo', [person('')]), null, 0)).toMatchObject({ wins: [0], first: 0 });
  const players = [person('Anna'), { name: '', strength: 'expert' as const }];
  expect(computersOf({ ...match, players }, 10)).toEqual([{ player: 1, strength: 'expert', seed: 11 }]);
});

test('the tower of a day follows from the day alone', () => {
  const day = dayOf(new Date('2026-03-09T23:59:59Z'));
  expect(day).toBe('2026-03-09');
  expect(dailySettings(day)).toMatchObject({ seed: 20260309, rows: 18, stiffness: 1e6, form: 'rigid' });
  expect(dailySettings('2026-03-10').seed).not.toBe(dailySettings(day).seed);
});

test('commands are rounded to hundredths of a millimetre, and rounding again changes nothing', () => {
  const command = {
    command: 'move' as const,
    displacement: [0.001234567, -0.0000049, 0] as [number, number, number],
    slot: null,
    toward_viewer: [0.70710678, -0.00001] as [number, number],
  };
  const once = rounded(command);
  expect(once).toEqual({ ...command, displacement: [0.00123, 0, 0], toward_viewer: [0.7071, 0] });
  expect(rounded(once)).toEqual(once);
  expect(JSON.stringify(once)).not.toContain('-0');
  expect(rounded({ command: 'poke' })).toEqual({ command: 'poke' });
});

test('thinned commands move the hand as far, in as many frames, with fewer moves', () => {
  const step = (k: number): GameCommand => ({
    command: 'move',
    displacement: [0.00013 + 1e-5 * (k % 3), -0.00002, 0],
    slot: null,
    toward_viewer: [1, 0.001 * k],
  });
  const steps = Array.from({ length: 40 }, (_, k) => step(k));
  const release: GameCommand = { command: 'release' };
  const commands: GameCommand[] = [{ command: 'idle' }, ...steps, { command: 'poke' }, ...steps, release];
  const moves = (list: GameCommand[]) => list.filter(command => command.command === 'move');
  const sum = (list: GameCommand[]) => moves(list).reduce((x, { displacement }) => x + displacement[0], 0);
  for (const stride of [1, 3, 6]) {
    const thin = thinned(commands, stride);
    expect(thin).toHaveLength(commands.length);
    expect(thin.findIndex(({ command }) => command === 'poke')).toBe(41);
    expect(thin[thin.length - 1]).toEqual(release);
    expect(moves(thin).length).toBeLessThanOrEqual(Math.ceil(80 / stride) + 1);
    expect(Math.abs(sum(thin) - sum(commands)), `stride ${stride}`).toBeLessThan(1e-4);
    for (const { displacement } of moves(thin))
      for (const x of displacement) expect(Math.abs(x * 1e4 - Math.round(x * 1e4))).toBeLessThan(1e-9);
  }
  expect(thinned([], 3)).toEqual([]);
});
