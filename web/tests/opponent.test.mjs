// Opponents, replays and analyses on the wasm face, as the workers of the page use them.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import { load } from './engine.mjs';

let face, memory, contest;
before(async () => {
  face = await load('simd128');
  ({ memory } = await face.default());
  contest = await readFile(new URL('../../data/golden/contest.record', import.meta.url));
});

const official = () => face.Game.rules('official', 2);
const message = action => {
  try {
    action();
  } catch (error) {
    assert.ok(error instanceof Error && !error.message.includes('\n'), `an Error of one line, not ${error}`);
    return error.message;
  }
  assert.fail('no error');
};

/** The tower and the players of crates/golden/src/record.rs. */
const start = () => {
  const game = new face.Game(face.towerScene('{"rows": 4, "seed": 11}'), '', official());
  game.startRecord();
  const players = ['skilled', 'beginner'];
  return { game, opponents: players.map((strength, seat) => new face.Opponent(seat, strength, 7, 10)) };
};

/** Plays until a player has lost, `limit` frames at most. `think` answers questions. */
function play({ game, opponents }, think = () => {}, limit = 20_000) {
  let turn = { player: 0 };
  for (let frame = 0; frame < limit && turn.phase !== 'over'; frame++) {
    const opponent = opponents[turn.player];
    think(opponent, game);
    ({ turn } = JSON.parse(game.step(opponent.next(game))));
  }
  return Buffer.from(game.record());
}

/** Answers the question of an opponent as another worker does. */
function answer(opponent, game) {
  const question = opponent.question(game);
  if (question === undefined) return 0;
  assert.equal(opponent.question(game), question, 'the same question until it is answered');
  const thought = new face.Thought(game.world(), question);
  let progress = 0;
  while (progress < 1) {
    const next = thought.step();
    assert.ok(next >= progress && next <= 1, `${progress} ${next}`);
    progress = next;
  }
  const [first, ...others] = JSON.parse(thought.considered());
  assert.ok(first.low <= first.chance_of_fall && first.chance_of_fall <= first.high && first.rollouts >= 1);
  assert.ok(others.every(other => other.cost >= first.cost));
  opponent.answer(thought.considered());
  thought.free();
  return 1;
}

test('a whole game of two opponents is that of native code, bit for bit', () => {
  assert.ok(play(start()).equals(contest), 'if opponents or bits had to change: tools/golden record');
});

test('a game whose questions are answered in another worker is the same', () => {
  let answers = 0;
  const record = play(start(), (opponent, game) => (answers += answer(opponent, game)));
  assert.ok(record.equals(contest));
  assert.ok(answers >= 2, `${answers} questions`);
});

test('a game that is reloaded from its record at any turn goes on the same', () => {
  const replay = new face.Replay(contest);
  const turns = [];
  for (let text; (text = replay.step());) {
    const { events, turn } = JSON.parse(text);
    if (events.some(({ event }) => event === 'turn_started')) turns.push({ frame: replay.frame, player: turn.player });
  }
  assert.ok(replay.isSame && turns.length >= 3);
  for (const { frame, player } of turns.slice(-2)) {
    const again = new face.Replay(contest);
    assert.ok(again.seek(frame, frame));
    const { opponents } = start();
    const game = again.playOn();
    // The frame in which the turn began is over.
    let turn = { player };
    while (turn.phase !== 'over') ({ turn } = JSON.parse(game.step(opponents[turn.player].next(game))));
    assert.ok(Buffer.from(game.record()).equals(contest), `from frame ${frame} on`);
  }
});

test('an opponent idles out of its turn and waits for its answer', () => {
  const { game, opponents } = start();
  for (let i = 0; i < 90; i++) game.step('');
  assert.deepEqual(JSON.parse(opponents[1].next(game)), { command: 'idle' });
  assert.equal(opponents[1].question(game), undefined);
  assert.ok(opponents[0].question(game));
  // Of no move it gives up.
  opponents[0].answer('[]');
  assert.deepEqual(JSON.parse(opponents[0].next(game)), { command: 'resign' });
});

test('strengths are a list, and one that is none is refused with their names', () => {
  const names = JSON.parse(face.Opponent.strengths()).map(({ strength }) => strength);
  assert.deepEqual(names, ['random', 'beginner', 'skilled', 'expert', 'gentle']);
  const line = message(() => new face.Opponent(0, 'master', 1));
  for (const name of ['master', ...names]) assert.ok(line.includes(name), line);
  assert.match(
    message(() => new face.Opponent(0, 'random', 1, -1)),
    /`budget` is -1/,
  );
  message(() => new face.Thought(new Uint8Array(5), '{}'));
  message(() => start().opponents[0].answer('{'));
});

const poses = replay => new Float64Array(memory.buffer, replay.posesPtr(), 7 * replay.length).slice();

test('a replay goes to any frame and back with the same poses', () => {
  const replay = new face.Replay(contest);
  const seen = new Map();
  const frames = [1, 700, 1300, replay.frames - 3];
  for (let text; (text = replay.step());)
    if (frames.includes(replay.frame)) seen.set(replay.frame, [poses(replay), text, replay.hash()]);
  for (const frame of [frames[2], frames[0], frames[3], frames[1]]) {
    while (!replay.seek(frame, 100));
    assert.deepEqual([poses(replay), replay.update, replay.hash()], seen.get(frame), `frame ${frame}`);
  }
  assert.ok(replay.isSame && replay.divergence() === undefined);
  assert.equal(JSON.parse(replay.rules()).table, 'official');
  assert.equal(replay.sizes().length, 3 * replay.length);
});

test('keyframes show a game without its engine', () => {
  const [keyframes, replay] = [new face.Keyframes(contest), new face.Replay(contest)];
  assert.equal(keyframes.length, replay.length);
  assert.deepEqual([...keyframes.sizes()], [...replay.sizes()]);
  assert.ok(Math.abs(keyframes.seconds - replay.frames / 60) < 1e-9);
  for (let second = 1; second <= 20; second++) {
    assert.ok(replay.seek(60 * second, 60));
    const [shown, actual] = [keyframes.poses(second), poses(replay)];
    for (let i = 0; i < shown.length; i++) {
      const tolerance = i % 7 < 3 ? 5e-5 : 1e-3;
      assert.ok(Math.abs(shown[i] - actual[i]) < tolerance, `number ${i} at ${second} s`);
    }
  }
  const [first, half, next] = [5, 5.5, 6].map(time => keyframes.poses(time));
  half.forEach((x, i) => {
    const [low, high] = [Math.min(first[i], next[i]), Math.max(first[i], next[i])];
    if (i % 7 < 3) assert.ok(x >= low - 1e-12 && x <= high + 1e-12);
  });
  assert.deepEqual([...keyframes.poses(1e9)], [...keyframes.poses(keyframes.seconds)]);
  assert.deepEqual([...keyframes.poses(NaN)], [...keyframes.poses(0)]);
});

test('bytes that are no record are refused by the name of their fault', () => {
  for (const open of [bytes => new face.Replay(bytes), bytes => new face.Keyframes(bytes), face.recordEngine]) {
    assert.match(
      message(() => open(contest.subarray(0, 100))),
      /truncated: 100 of/,
    );
    assert.match(
      message(() => open(new Uint8Array([1, 2]))),
      /no record/,
    );
    const altered = Uint8Array.from(contest);
    altered[200] ^= 1;
    assert.match(
      message(() => open(altered)),
      /altered/,
    );
  }
  assert.equal(face.recordEngine(contest), face.engineId());
});

test('each block of a tower has a chance of a fall, and a budget has its end', () => {
  const game = new face.Game(face.towerScene('{"rows": 3, "seed": 2}'), '');
  for (let i = 0; i < 60; i++) game.step('');
  const analysis = new face.TowerAnalysis(game.world(), '', 1, 0);
  let progress = 0;
  while (progress < 1) {
    const next = analysis.step();
    assert.ok(next >= progress);
    progress = next;
  }
  const blocks = JSON.parse(analysis.blocks());
  assert.deepEqual(
    blocks.map(({ body }) => body),
    [0, 1, 2, 3, 4, 5, 6, 7, 8],
  );
  for (const { chance_of_fall, low, high, rollouts, force_N, held_by } of blocks) {
    assert.ok(low <= chance_of_fall && chance_of_fall <= high && rollouts === 1);
    assert.ok(force_N > 0.05 && Array.isArray(held_by));
  }
  assert.ok(blocks.slice(6).every(({ held_by }) => held_by.length === 0));
});

test('a record is analysed move by move, and says why it fell', () => {
  const analysis = new face.RecordAnalysis(contest, 1, 0);
  while (analysis.step() < 1);
  const { moves, riskiest, fall } = JSON.parse(analysis.report());
  assert.ok(moves.length >= 2 && moves.every(move => move.low <= move.high && move.rollouts === 1));
  assert.ok(moves.every(move => move.chance_of_fall <= moves[riskiest].chance_of_fall));
  if (fall) {
    assert.equal(moves.at(-1).fell, true);
    assert.equal(fall.taken, moves.at(-1).body);
  }
});
