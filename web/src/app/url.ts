// Options in the address of the page: for links, slow devices and tests.

import type { Form } from '../engine/game-protocol';
import type { BlockPreset } from '../engine/protocol';
import { TIERS } from '../view/quality';

export interface Options {
  /** Mode of play; null for the default. */
  mode: string | null;
  rows: number;
  seed: number;
  block: BlockPreset;
  /** Name of a listed scene; null for the tower. */
  scene: string | null;
  sleep: boolean;
  /** Stiffness of the contacts, N/m; null for the stiffest that the device runs in real time. */
  stiffness: number | null;
  /** Null leaves the choice to the device. */
  form: Form | null;
  /** Stiffness of the springs inside the blocks, N/m; null for that of the contacts. */
  springs: number | null;
  /** Largest force of the hand, N. */
  maxForce: number;
  /** `once` draws one picture a second. */
  render: 'always' | 'once';
  /** Fraction of the full resolution. */
  scale: number;
  /** Index of a fixed quality tier; null for automatic quality. */
  tier: number | null;
  /** True if the help may open by itself. */
  help: boolean;
}

export interface Range {
  min: number;
  max: number;
}

export const ROWS: Range = { min: 3, max: 40 };
/** Largest force of the hand, N. */
export const MAX_FORCE: Range = { min: 1, max: 8 };
/** Contact stiffness that the engine accepts, N/m. */
export const STIFFNESS: Range = { min: 1e4, max: 1e8 };
/** Stiffness of the springs inside blocks, N/m: from jelly to more than wood. */
export const SPRINGS: Range = { min: 1e3, max: 1e8 };
export const SEED: Range = { min: 0, max: 2 ** 32 - 1 };

function number(text: string | null, fallback: number, { min, max }: Range): number {
  const value = text === null || text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? Math.min(max, Math.max(min, value)) : fallback;
}

/** Reads a query string; invalid values count as absent. */
export function readOptions(search: string): Options {
  const query = new URLSearchParams(search);
  const tier = TIERS.findIndex(t => t.name === query.get('quality'));
  const small = query.get('view') === 'small';
  return {
    mode: query.get('mode'),
    rows: Math.round(number(query.get('rows'), 18, ROWS)),
    seed: Math.round(number(query.get('seed'), 1, SEED)),
    block: query.get('block') === 'official' ? 'official' : 'dissertation',
    scene: query.get('scene'),
    sleep: query.get('sleep') !== '0',
    stiffness: number(query.get('stiffness'), 0, STIFFNESS) || null,
    form: (['rigid', 'lattice'] as const).find(form => form === query.get('form')) ?? null,
    springs: number(query.get('springs'), 0, SPRINGS) || null,
    maxForce: number(query.get('cap'), 4, MAX_FORCE),
    render: query.get('render') === 'once' ? 'once' : 'always',
    scale: number(query.get('scale'), small ? 0.5 : 1, { min: 0.1, max: 1 }),
    tier: tier >= 0 ? tier : small ? 0 : null,
    help: query.get('help') !== '0',
  };
}
