// The instrument: a graph of Web Audio that plays knocks, and scrapes, creaks and rumbles without
// end whose gains follow the tower.

import type { Waves } from './waves';

/** Time constant with which a gain follows, s: long enough not to click, shorter than a frame. */
const FOLLOW = 0.012;
/** Time constant of the rumble, which outlasts the impacts, s. */
const FADE = 0.12;
/** Gains of the parts at full level, so that a collapse is not louder than one hard knock. */
const PART = { knock: 0.75, scrape: 0.34, creak: 0.22, rumble: 0.5 };

/** A sound that goes on, with a gain. */
interface Steady {
  source: AudioBufferSourceNode;
  band: BiquadFilterNode;
  gain: GainNode;
}

export class Instrument {
  private readonly output: GainNode;
  private readonly knocks: AudioBuffer;
  private readonly scrapes: Steady;
  private readonly creaks: Steady;
  private readonly rumbles: Steady;

  constructor(
    private readonly context: BaseAudioContext,
    volume: number,
    waves: Waves,
  ) {
    // Many knocks at once are compressed, not clipped.
    const limiter = new DynamicsCompressorNode(context, { threshold: -14, ratio: 8, attack: 0.002, release: 0.12 });
    this.output = new GainNode(context, { gain: volume });
    this.output.connect(limiter).connect(context.destination);
    this.knocks = this.buffer(waves.knock);
    const noise = this.buffer(waves.roughness);
    this.scrapes = this.steady(noise, { type: 'bandpass', frequency: 1500, Q: 0.9 });
    this.rumbles = this.steady(noise, { type: 'lowpass', frequency: 260, Q: 0.7 });
    this.creaks = this.steady(this.buffer(waves.creak), { type: 'bandpass', frequency: 900, Q: 0.8 });
  }

  setVolume(volume: number): void {
    this.output.gain.setTargetAtTime(volume, this.context.currentTime, FOLLOW);
  }

  /** Plays a knock. `pan`: -1 left to 1 right. */
  knock(gain: number, pitch: number, pan: number, at = this.context.currentTime): void {
    const source = new AudioBufferSourceNode(this.context, { buffer: this.knocks, playbackRate: pitch });
    // A harder hit is brighter, as its contact is shorter.
    const tone = new BiquadFilterNode(this.context, { type: 'lowpass', frequency: 900 + 9000 * gain });
    const level = new GainNode(this.context, { gain: PART.knock * gain });
    source.connect(tone).connect(level).connect(new StereoPannerNode(this.context, { pan })).connect(this.output);
    source.start(at);
  }

  /** Sets the gain (0 to 1) and the band (Hz) of the scrape. */
  scrape(gain: number, band: number, at = this.context.currentTime): void {
    this.scrapes.gain.gain.setTargetAtTime(PART.scrape * gain, at, FOLLOW);
    this.scrapes.band.frequency.setTargetAtTime(band, at, FOLLOW);
  }

  /** Sets the gain of the creak, 0 to 1; the higher it is, the faster the wood gives. */
  creak(gain: number, at = this.context.currentTime): void {
    this.creaks.gain.gain.setTargetAtTime(PART.creak * gain, at, gain > 0 ? FOLLOW : 4 * FOLLOW);
    this.creaks.source.playbackRate.setTargetAtTime(0.7 + 0.6 * gain, at, FOLLOW);
  }

  /** Sets the gain of the rumble, 0 to 1. */
  rumble(gain: number, at = this.context.currentTime): void {
    this.rumbles.gain.gain.setTargetAtTime(PART.rumble * gain, at, gain > 0 ? FOLLOW : FADE);
  }

  private buffer(samples: Float32Array<ArrayBuffer>): AudioBuffer {
    const buffer = new AudioBuffer({ length: samples.length, sampleRate: this.context.sampleRate });
    buffer.copyToChannel(samples, 0);
    return buffer;
  }

  private steady(buffer: AudioBuffer, filter: BiquadFilterOptions): Steady {
    const source = new AudioBufferSourceNode(this.context, { buffer, loop: true });
    const band = new BiquadFilterNode(this.context, filter);
    const gain = new GainNode(this.context, { gain: 0 });
    source.connect(band).connect(gain).connect(this.output);
    source.start();
    return { source, band, gain };
  }
}
