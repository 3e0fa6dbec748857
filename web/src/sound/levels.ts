// From mechanics to loudness and pitch: pure functions, the same for every instrument.

/** Impulses just heard, and as loud as any, N s: a touch at 3 cm/s, and a fall of 0.5 m. */
export const IMPULSE = { min: 2e-4, max: 6e-2 };
/** Power of sliding (normal force times speed) that is just heard, and as loud as any, W. */
export const POWER = { min: 5e-5, max: 0.05 };
/** Speeds of sliding between which the pitch of a scrape rises, m/s. */
const SPEED = { min: 0.005, max: 0.6 };
/** Centre of the band of a scrape at these speeds, Hz. */
const BAND = { min: 900, max: 4200 };
/** Exponent of loudness: gains are to sound alike far apart, as ears hear by ratios. */
const EXPONENT = 0.62;
/** Force of a hand, over its largest, from which a block that does not move creaks. */
const STRAINED = 0.3;

/** Returns the gain of a knock for its impulse (N s): 0 to 1, never falling. */
export function knockGain(impulse: number): number {
  return between(impulse, IMPULSE) ** EXPONENT;
}

/** Returns the gain of a scrape for the power of its friction (W): 0 to 1, never falling. */
export function scrapeGain(power: number): number {
  return between(power, POWER) ** EXPONENT;
}

/** Returns the centre of the band of a scrape at a speed (m/s), Hz. */
export function scrapeBand(speed: number): number {
  const level = Math.log(Math.max(speed, SPEED.min) / SPEED.min) / Math.log(SPEED.max / SPEED.min);
  return BAND.min * (BAND.max / BAND.min) ** Math.min(1, level);
}

/** Load of the hand on a block that sits tight. */
export interface Strain {
  /** Force over the largest of the hand. */
  force: number;
  /** Change of that since the last frame. */
  change: number;
  /** Speed of the block, m/s. */
  speed: number;
}

/**
 * Returns the gain of a creak, 0 to 1: wood is heard when its load grows and it does not yet move.
 */
export function creakGain({ force, change, speed }: Strain): number {
  if (force < STRAINED || change <= 0 || speed > 0.004) return 0;
  return Math.min(1, ((force - STRAINED) / (1 - STRAINED)) * Math.min(1, change / 0.02));
}

/**
 * Returns the gain of the rumble of a collapse for the impulses of a frame (N s) and their number.
 */
export function rumbleGain(impulses: number, count: number): number {
  return count < 3 ? 0 : Math.min(1, impulses / 0.08);
}

/** Returns the pitch of a block's knock over that of the first: each block has its own. */
export function pitchOf(body: number): number {
  // The golden ratio spreads neighbours as far apart as can be.
  return 0.84 + 0.36 * ((body * 0.6180339887) % 1);
}

function between(value: number, { min, max }: { min: number; max: number }): number {
  return value <= min ? 0 : Math.min(1, (value - min) / (max - min));
}
