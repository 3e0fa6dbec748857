// What the page remembers from visit to visit. Storage may be forbidden or full: it then remembers
// nothing, and nothing else fails.

/** Returns what was remembered, or null. */
export function recall(key: string): string | null {
  try {
    return localStorage.getItem(`teeter.${key}`);
  } catch {
    return null;
  }
}

/** Remembers a value; returns false where that is not possible. */
export function remember(key: string, value: string): boolean {
  try {
    localStorage.setItem(`teeter.${key}`, value);
    return true;
  } catch {
    return false;
  }
}
