// A mode of play: its rules, and what it shows and says. Each mode is a file; index.ts lists them.

import type { Options } from '../app/url';
import type { Contact, GameCommand, GameEvent, Update } from '../engine/game-protocol';

/** Rules for the hand of a player. */
export interface Rules {
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
  /** Rules for the options of the page. */
  rules(options: Options): Rules;
  /** Overlay after an update of a tower of `blocks` blocks. */
  overlay(update: Update, blocks: number): ModeOverlay;
  onEvent(event: GameEvent, ui: ModeUi): void;
  /** Commands of the mode itself after an update, as of an opponent. */
  commands?(update: Update): GameCommand[];
}
