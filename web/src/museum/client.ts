// The page's end of the museum's worker: that of the game, with requests to the hand of 2003 and
// its constants.

import { Client } from '../engine/client';
import type { ConstantEntry, ConstantValues, MuseumFrame, MuseumSetup, Request2003 } from './protocol';

export class MuseumClient extends Client<MuseumSetup, MuseumFrame> {
  /** Sends a request to the hand of 2003. */
  request(request: Request2003): void {
    this.post({ type: 'request', world: this.world, request });
  }

  /** Sets constants of the standing tower; returns null, or why they are not accepted. */
  setConstants(values: ConstantValues): Promise<string | null> {
    return this.inquire({ what: 'set', values }) as Promise<string | null>;
  }

  /** Returns the constants that can be set. */
  constants(): Promise<ConstantEntry[]> {
    return this.inquire({ what: 'constants' }) as Promise<ConstantEntry[]>;
  }
}
