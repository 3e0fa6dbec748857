// Sounds of a frame, as the engine lists them: seven numbers each.

/** Numbers of a sound: kind, body, strength, speed, position. */
export const SOUND_STRIDE = 7;

export interface Heard {
  body: number;
  /** Impulse of an impact, N s; normal force of a slide, N. */
  strength: number;
  /** m/s. */
  speed: number;
  /** m. */
  point: [number, number, number];
}

/** Impacts and slides of a frame, the strongest first. */
export interface FrameSounds {
  impacts: Heard[];
  slides: Heard[];
}

/** Reads the numbers of a frame. */
export function readSounds(numbers: ArrayLike<number>): FrameSounds {
  const sounds: FrameSounds = { impacts: [], slides: [] };
  for (let at = 0; at < numbers.length; at += SOUND_STRIDE) {
    const [kind, body, strength, speed, x, y, z] = Array.from({ length: SOUND_STRIDE }, (_, k) => numbers[at + k]);
    (kind === 0 ? sounds.impacts : sounds.slides).push({ body, strength, speed, point: [x, y, z] });
  }
  return sounds;
}
