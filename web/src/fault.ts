// What a worker does about faults.

/** What failed, as one line for the user. */
export function text(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** Runs what may fail. A fault leaves wasm memory in no known state: `ended` ends what is in it, and tells the page. */
export function guarded(ended: (message: string) => void): (action: () => void) => void {
  return action => {
    try {
      action();
    } catch (error) {
      ended(text(error));
    }
  };
}
