// The languages of the pages, and the choice of one. A further language is a file with the keys of
// en.ts and a line in this list.

import { recall, remember } from '../app/memory';
import { de } from './de';
import { en, type Messages } from './en';

/** Texts by language (BCP 47), the default first. */
export const LANGUAGES: Readonly<Record<string, Messages>> = { en, de };

/**
 * Returns the language for a page: that of the address (`lang`), else the player's choice, else the
 * first language that the browser asks for and that there is, else English.
 */
export function languageFor(search: string, choice: string | null, preferred: readonly string[]): string {
  const named = new URLSearchParams(search).get('lang');
  for (const candidate of [named, choice, ...preferred]) {
    const language = candidate?.toLowerCase().split('-')[0];
    if (language && Object.hasOwn(LANGUAGES, language)) return language;
  }
  return 'en';
}

/** Returns the player's choice, or null. */
export function chosenLanguage(): string | null {
  return recall('language');
}

/** Loads the page again in a language, and keeps the choice for later visits. */
export function chooseLanguage(language: string): void {
  const address = new URL(location.href);
  address.searchParams.delete('lang');
  // Where nothing can be remembered, the address keeps the choice.
  if (!remember('language', language)) address.searchParams.set('lang', language);
  location.replace(address);
}
