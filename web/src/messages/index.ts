// The texts of this page, in the language of the player.

import type { Messages } from './en';
import { formatsOf } from './formats';
import { chosenLanguage, LANGUAGES, languageFor } from './languages';

/** Language of the page (BCP 47). */
export const language =
  typeof document === 'undefined'
    ? 'en'
    : languageFor(location.search, chosenLanguage(), navigator.languages ?? [navigator.language]);

export const text: Messages = LANGUAGES[language];

/** Texts of the modes of play. */
export const { games } = text;

export const { decimal, significant, count, list } = formatsOf(language);
