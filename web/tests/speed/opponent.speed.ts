// How long a computer player thinks in the middle of a game of 18 rows: figures, no bounds.

import { afterAll, beforeAll, test } from 'vitest';
import { STRENGTHS, type Match, type Strength } from '../../src/modes/match';
import type { SavedGame } from '../../src/records/storage';
import { load } from '../engine.mjs';
import { host, Session, SMALL, type Host } from '../page/browser';

const DECISIONS = 10;
const QUERY = `${SMALL}&render=once&mode=opponent`;

declare global {
  interface Window {
    /** Times at which thoughts began and ended, ms. */
    thoughts: number[];
  }
}

let chrome: Host;
/** A game of two on a tower from the middle of a game, at rest before the first move. */
let record: number[];
beforeAll(async () => {
  const { Game, namedScene } = await load('simd128');
  const scene = JSON.stringify({ ...JSON.parse(namedScene('midgame')), stiffness: 1e6, form: 'rigid' });
  const game = new Game(scene, JSON.stringify({ sleep: true, frame: 1 / 60 }), Game.rules('official', 2));
  game.startRecord();
  for (let frame = 0; frame < 60; frame++) game.step('');
  record = [...game.record(true)!];
  chrome = await host();
}, 120_000);
afterAll(() => chrome?.stop());

/** Notes when the card of the turn says that somebody thinks, and when it no longer does. */
const noteThoughts = () =>
  addEventListener('DOMContentLoaded', () => {
    window.thoughts = [];
    let thinks = false;
    new MutationObserver(() => {
      const now = document.querySelector('#turn-step.thinking') !== null;
      if (now !== thinks) window.thoughts.push(performance.now());
      thinks = now;
    }).observe(document.body, { subtree: true, attributes: true, attributeFilter: ['class'] });
  });

/** Time of a decision, s: the game is stored as that of the tab, which is loaded again. */
async function decide({ page }: Session, strength: Strength, seed: number): Promise<number> {
  const players = [
    { name: '', strength },
    { name: '', strength: null },
  ];
  const match: Match = { mode: 'opponent', table: 'official', players, first: 0, wins: [0, 0] };
  const settings = { scene: null, rows: 18, seed, block: 'dissertation', sleep: true } as const;
  const tab = `${strength} ${seed}`;
  const saved = { tab, match, settings: { ...settings, stiffness: 1e6, form: 'rigid', springs: null }, turn: 1 };
  await page.evaluate(
    async ({ saved, record }) => {
      const game = { ...saved, at: Date.now(), search: location.search, record: Uint8Array.from(record) } as SavedGame;
      const db = await new Promise<IDBDatabase>((resolve, reject) => {
        const open = indexedDB.open('teeter');
        open.onsuccess = () => resolve(open.result);
        open.onerror = () => reject(open.error);
      });
      await new Promise((resolve, reject) => {
        const transaction = db.transaction('games', 'readwrite');
        transaction.objectStore('games').put(game);
        transaction.oncomplete = resolve;
        transaction.onerror = () => reject(transaction.error);
      });
      db.close();
      sessionStorage.setItem('teeter.tab', game.tab);
    },
    { saved, record },
  );
  await page.reload();
  await page.waitForFunction(() => window.thoughts?.length >= 2, undefined, { polling: 50 });
  const [begin, end] = await page.evaluate(() => window.thoughts);
  return (end - begin) / 1000;
}

test('ten decisions at each strength in the middle of a game', async () => {
  await using session = await Session.open(chrome, QUERY, { before: page => page.addInitScript(noteThoughts) });
  const { awake, cores } = await session.page.evaluate(() => ({
    awake: window.teeter.awake,
    cores: navigator.hardwareConcurrency,
  }));
  console.log(`cores ${cores}, blocks awake ${awake}`);
  for (const strength of STRENGTHS) {
    const times: number[] = [];
    for (let seed = 1; seed <= DECISIONS; seed++) times.push(await decide(session, strength, seed));
    times.sort((a, b) => a - b);
    const [median, max] = [times[DECISIONS / 2], times[DECISIONS - 1]];
    console.log(`decision, ${strength.padEnd(10)} median ${median.toFixed(2)} s, longest ${max.toFixed(2)} s`);
  }
}, 1_800_000);
