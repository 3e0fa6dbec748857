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
