// Errors in a worker.

/** Message of an error as one line for the user. */
export function errorText(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/**
 * Runs an action that may throw. An error leaves wasm memory in an unknown state: `failed` drops
 * its objects and reports it.
 */
export function guarded(failed: (message: string) => void): (action: () => void) => void {
  return action => {
    try {
      action();
    } catch (error) {
      failed(errorText(error));
    }
  };
}

/**
 * True for an error by which a reader or the engine refuses an input: a plain Error, after which
 * all is as it was. A panic is a RuntimeError of WebAssembly, and a fault of the worker a TypeError
 * or the like.
 */
export function isRefusal(error: unknown): error is Error {
  return error instanceof Error && error.constructor === Error;
}
