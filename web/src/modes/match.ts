// A match: its mode, its players and its rules. It goes on from one game to the next.

import type { ComputerPlayer, RulesChoice, TableName } from '../engine/protocol';
import { games } from '../messages';

/** Strength of a computer player. */
export type Strength = 'random' | 'beginner' | 'skilled' | 'expert' | 'gentle';

/** Strengths that players choose from, the weakest first. */
export const STRENGTHS: readonly Strength[] = ['random', 'beginner', 'gentle', 'skilled', 'expert'];

export interface Player {
  name: string;
  /** Null for a person. */
  strength: Strength | null;
}

export interface Match {
  /** Name of the mode. */
  mode: string;
  table: TableName;
  players: Player[];
  /** Player who begins, from 0. */
  first: number;
  /** Games won by each player. */
  wins: number[];
  /** Duration of the pull that is to be beaten, s. */
  goal?: number;
}

/** Largest number of players. */
export const MAX_PLAYERS = 8;

/** Tables that players choose from, the default first. */
export const TABLES: readonly TableName[] = ['official', 'strict', 'friendly', 'dissertation', 'throw-and-go'];

export function person(name: string): Player {
  return { name, strength: null };
}

export function matchOf(mode: string, table: TableName, players: Player[]): Match {
  return { mode, table, players, first: 0, wins: players.map(() => 0) };
}

/** Name of a player, from 0. */
export function nameOf(match: Match, player: number): string {
  return match.players[player]?.name || games.player(player + 1);
}

/** Rules of the next game; null for free play. `seed` is that of the die. */
export function rulesOf({ table, players, first }: Match, seed: number): RulesChoice | null {
  if (table === 'free') return null;
  const rules = { table, players: players.length, first };
  return table === 'throw-and-go' ? { ...rules, die: seed } : rules;
}

/** The match after a game: a win more, and the loser begins. */
export function after(match: Match, winner: number | null, loser: number | null): Match {
  const wins = match.wins.map((n, player) => (player === winner ? n + 1 : n));
  return { ...match, wins, first: loser ?? match.first };
}

/** Computer players of the next game; `seed` is that of its tower. */
export function computersOf({ players }: Match, seed: number): ComputerPlayer[] {
  return players.flatMap(({ strength }, player) => (strength ? [{ player, strength, seed: seed + player }] : []));
}
