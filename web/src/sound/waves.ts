// Waves of wood, computed: a knock by the modes of a bar, a scrape and a rumble by noise, a creak
// by slips that follow each other.

/** Ratios of the first bending modes of a free bar, and their amplitudes when it is hit. */
const MODES = [
  { ratio: 1, amplitude: 1, decay: 0.028 },
  { ratio: 2.756, amplitude: 0.55, decay: 0.014 },
  { ratio: 5.404, amplitude: 0.28, decay: 0.007 },
];
/** First mode of a block, Hz, and the thud of what it stands on. */
const PITCH = 880;
const THUD = { pitch: 190, amplitude: 0.6, decay: 0.032 };
/** Duration of the hit itself, s. */
const HIT = 0.0012;
/** Slips of a creak a second, and the ring of each, Hz and s. */
const CREAK = { rate: 34, pitch: 620, decay: 0.006 };

type Wave = Float32Array<ArrayBuffer>;

/** Waves of an instrument. */
export interface Waves {
  knock: Wave;
  roughness: Wave;
  creak: Wave;
}

/** Returns the waves at a sample rate (Hz). */
export function wavesAt(rate: number): Waves {
  return { knock: knock(rate), roughness: roughness(rate), creak: creak(rate) };
}

/** Uniform noise from -1 to 1 that is the same in each run. */
function noise(): () => number {
  let state = 0x2545f491;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 31 - 1;
  };
}

/** Returns a knock at a sample rate (Hz). */
export function knock(rate: number): Wave {
  const wave = new Float32Array(Math.round(0.22 * rate));
  const random = noise();
  for (let i = 0; i < wave.length; i++) {
    const t = i / rate;
    const attack = Math.min(1, t / 0.0006);
    let value = 0.35 * random() * Math.exp(-t / HIT);
    for (const { ratio, amplitude, decay } of MODES)
      value += amplitude * Math.sin(2 * Math.PI * PITCH * ratio * t) * Math.exp(-t / decay);
    value += THUD.amplitude * Math.sin(2 * Math.PI * THUD.pitch * t) * Math.exp(-t / THUD.decay);
    wave[i] = attack * value;
  }
  return normalized(wave);
}

/** Returns two seconds of the noise of rough faces, which repeat without a seam (Hz). */
export function roughness(rate: number): Wave {
  const wave = new Float32Array(2 * rate);
  const random = noise();
  // Fibres of wood come in bunches: the noise is modulated by slower noise.
  let bunch = 0;
  for (let i = 0; i < wave.length; i++) {
    bunch += 0.004 * (random() - bunch);
    wave[i] = random() * (0.55 + 9 * Math.abs(bunch));
  }
  return normalized(seamless(wave, Math.round(0.05 * rate)));
}

/** Returns two seconds of a creak: slips at nearly even times, each a short ring. */
export function creak(rate: number): Wave {
  const wave = new Float32Array(2 * rate);
  const random = noise();
  for (let at = 0; at < 2; at += (1 + 0.35 * random()) / CREAK.rate) {
    const strength = 0.6 + 0.4 * random();
    const from = Math.round(at * rate);
    for (let i = 0; i < 8 * CREAK.decay * rate; i++) {
      const t = i / rate;
      const ring = Math.sin(2 * Math.PI * CREAK.pitch * t) + 0.5 * Math.sin(2 * Math.PI * 2.3 * CREAK.pitch * t);
      wave[(from + i) % wave.length] += strength * ring * Math.exp(-t / CREAK.decay);
    }
  }
  return normalized(wave);
}

/** Lets the end of a wave pass into its beginning over so many samples. */
function seamless(wave: Wave, overlap: number): Wave {
  const length = wave.length - overlap;
  for (let i = 0; i < overlap; i++) {
    const part = i / overlap;
    wave[i] = Math.sqrt(part) * wave[i] + Math.sqrt(1 - part) * wave[length + i];
  }
  return wave.slice(0, length);
}

function normalized(wave: Wave): Wave {
  const peak = wave.reduce((max, value) => Math.max(max, Math.abs(value)), 0);
  return wave.map(value => value / peak);
}
