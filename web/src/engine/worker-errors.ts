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
function isRefusal(error: unknown): error is Error {
  return error instanceof Error && error.constructor === Error;
}

/**
 * Runs an action. An error by which an input is refused is answered with its reason; any other is
 * thrown.
 */
export function unlessRefused(action: () => void, answer: (message: string) => void): void {
  try {
    action();
  } catch (error) {
    if (!isRefusal(error)) throw error;
    answer(errorText(error));
  }
}
