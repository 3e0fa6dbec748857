// Features of the browser that the page cannot run without.

export const NO_WEBGL =
  'This browser gives the page no WebGL 2, with which the tower is drawn. It may be switched off in the settings, or the graphics driver may be too old.';

/** Returns a sentence about a missing feature, or null. */
export function missingFeature(): string | null {
  if (typeof WebAssembly !== 'object')
    return 'This browser cannot run WebAssembly, in which the physics is written. A current version of any browser can.';
  if (typeof Worker !== 'function')
    return 'This browser allows no workers, in which the physics runs. A current version of any browser does.';
  return null;
}
