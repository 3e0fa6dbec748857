// Texts of the modes of play, in the language of the player.

import { gamesEn } from './games-en';

export const games = gamesEn;
