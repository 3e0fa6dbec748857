// Features of the browser that the page cannot run without.

import { text } from '../messages';

/** Returns a sentence about a missing feature, or null. */
export function missingFeature(): string | null {
  if (typeof WebAssembly !== 'object') return text.trouble.noWasm;
  if (typeof Worker !== 'function') return text.trouble.noWorkers;
  return null;
}
