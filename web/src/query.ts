// What the address of the page asks for: for links, and for devices or tests that must be spared.

import type { BlockPreset, Form } from './protocol';
import { TIERS } from './quality';

export interface Options {
  rows: number;
  seed: number;
  block: BlockPreset;
  /** Name of a scene of the list; null for the tower. */
  scene: string | null;
  sleep: boolean;
  /** Stiffness of the contacts, N/m; null for the stiffest that the device holds in real time. */
  stiffness: number | null;
  /** What the blocks are; null for what the device holds. */
  form: Form | null;
  /** Stiffness of the springs within the blocks, N/m; null for that of the contacts. */
  springs: number | null;
  /** Largest force of the hand, N. */
  cap: number;
  /** `once`: one picture a second. */
  render: 'always' | 'once';
  /** Part of the full resolution. */
  scale: number;
  /** Index of a fixed quality tier; null lets the page find one. */
  tier: number | null;
  /** Whether the help sheet may open by itself. */
  help: boolean;
}

export const ROWS = { least: 3, most: 40 };
export const CAP = { least: 1, most: 8 };
/** What the engine takes, N/m. */
export const STIFFNESS = { least: 1e4, most: 1e8 };
/** Of the springs within blocks, N/m: from jelly to more than wood. */
export const SPRINGS = { least: 1e3, most: 1e8 };
export const MOST_SEED = 2 ** 32 - 1;

function number(text: string | null, usual: number, least: number, most: number): number {
  const value = text === null || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? Math.min(most, Math.max(least, value)) : usual;
}

/** Reads a query string; what makes no sense is taken as absent. */
export function readOptions(search: string): Options {
  const query = new URLSearchParams(search);
  const tier = TIERS.findIndex(t => t.name === query.get('quality'));
  const small = query.get('view') === 'small';
  return {
    rows: Math.round(number(query.get('rows'), 18, ROWS.least, ROWS.most)),
    seed: Math.round(number(query.get('seed'), 1, 0, MOST_SEED)),
    block: query.get('block') === 'official' ? 'official' : 'dissertation',
    scene: query.get('scene'),
    sleep: query.get('sleep') !== '0',
    stiffness: number(query.get('stiffness'), 0, STIFFNESS.least, STIFFNESS.most) || null,
    form: (['rigid', 'lattice'] as const).find(form => form === query.get('form')) ?? null,
    springs: number(query.get('springs'), 0, SPRINGS.least, SPRINGS.most) || null,
    cap: number(query.get('cap'), 4, CAP.least, CAP.most),
    render: query.get('render') === 'once' ? 'once' : 'always',
    scale: number(query.get('scale'), small ? 0.5 : 1, 0.1, 1),
    tier: tier >= 0 ? tier : small ? 0 : null,
    help: query.get('help') !== '0',
  };
}
