// A mode of play: its rules, and what it shows and says. Each mode is a file; index.ts lists them.

import type { Contact, GameCommand, GameEvent, Update } from '../engine/game-protocol';
import type { Match } from './match';

/** Rules for the hand of a player. */
export interface HandRules {
  /** True if the hand can turn a carried block. */
  canTurn: boolean;
}

/** Parts of the picture that a mode decides. */
export interface ModeOverlay {
  /** Line beneath the title. */
  status: string;
}

/** Access of a mode to the page. */
export interface ModeUi {
  /** Shows a line for some seconds. */
  notice(text: string, seconds?: number): void;
  /** Returns the contacts of a block. */
  contacts(body: number): Promise<Contact[]>;
}

export interface Mode {
  readonly id: string;
  /** Match of an address that names the mode. */
  match(): Match;
  /** Rules for the hand in a new game. */
  rules(): HandRules;
  /** True if turns can be taken back. */
  readonly undo?: boolean;
  /** True if the page only watches, as in a replay. */
  readonly watches?: boolean;
  /** Overlay after an update of a tower of `blocks` blocks. */
  overlay(update: Update, blocks: number, match: Match): ModeOverlay;
  onEvent(event: GameEvent, ui: ModeUi, match: Match): void;
  /** Commands of the mode itself after an update. */
  commands?(update: Update): GameCommand[];
}
