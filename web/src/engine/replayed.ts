// A record as it can be played again here: by the engine that wrote it, else by its keyframes.

import type { Keyframes } from '../wasm/teeter_wasm.js';
import { KeyframedGame } from './keyframed-game';
import type { Replayed } from './played';
import { engineOf, type LoadedEngine } from './record-engine';
import { ReplayedGame } from './replayed-game';

/** Engine of this page, which reads the keyframes of any record. */
export type OwnEngine = LoadedEngine & { engine: { Keyframes: typeof Keyframes } };

/**
 * Opens a record with `own`, the engine of this page, or with a kept one below the address
 * `engines`. Throws an Error whose message is for the user where the bytes are no record.
 */
export async function replayed(record: Uint8Array, own: OwnEngine, engines: URL): Promise<Replayed> {
  const found = await engineOf(record, own, engines);
  if (!found) return new KeyframedGame(new own.engine.Keyframes(record));
  return new ReplayedGame(record, found, found === own ? 'own' : 'kept');
}
