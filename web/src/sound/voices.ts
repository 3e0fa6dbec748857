// Choice of the impacts that are played: no more at once than ears separate, and none twice.

/** Most knocks that sound at the same time. */
export const VOICES = 12;
/** Duration of a knock that counts, s: its tail covers no other. */
const DURATION = 0.09;
/** Time within which a block is heard once, s: the bounces within are one knock. */
const AGAIN = 0.045;

export interface Impact {
  body: number;
  gain: number;
}

/** Chooses the impacts to play. */
export class Voices {
  private playing: { until: number; gain: number }[] = [];
  private readonly last = new Map<number, number>();

  /** Returns the impacts of a frame that are played at a time (s), the loudest first. */
  choose<I extends Impact>(impacts: readonly I[], now: number): I[] {
    this.playing = this.playing.filter(voice => voice.until > now);
    const chosen: I[] = [];
    for (const impact of [...impacts].sort((a, b) => b.gain - a.gain)) {
      if (impact.gain <= 0 || this.playing.length >= VOICES) break;
      if (now - (this.last.get(impact.body) ?? -Infinity) < AGAIN) continue;
      this.last.set(impact.body, now);
      this.playing.push({ until: now + DURATION, gain: impact.gain });
      chosen.push(impact);
    }
    return chosen;
  }

  /** Begins with other blocks. */
  clear(): void {
    this.playing = [];
    this.last.clear();
  }
}
