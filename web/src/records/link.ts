// Links that hold a record in their fragment, which no server sees.

const KEY = 'move';
/** Longest link, bytes: what messengers take. Most pulls need half of it or less. */
export const MAX_LINK = 4096;

/** Returns the address of this page with a record. */
export function linkOf(record: Uint8Array, page: string): string {
  return `${page.split(/[?#]/)[0]}#${KEY}=${toText(record)}`;
}

/** Returns the record in the fragment of an address, or null. */
export function recordIn(hash: string): Uint8Array | null {
  const text = new URLSearchParams(hash.replace(/^#/, '')).get(KEY);
  return text ? fromText(text) : null;
}

/** Encodes bytes in base64url. */
export function toText(bytes: Uint8Array): string {
  const binary = Array.from(bytes, byte => String.fromCharCode(byte)).join('');
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** Decodes base64url; null for text that is none. */
export function fromText(text: string): Uint8Array | null {
  if (!/^[A-Za-z0-9_-]*$/.test(text)) return null;
  try {
    const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
    return Uint8Array.from(binary, letter => letter.charCodeAt(0));
  } catch {
    return null;
  }
}
