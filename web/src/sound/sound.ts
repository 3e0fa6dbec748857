// The sound of the game: from the frames of the engine to the instrument.

import { remember } from '../app/memory';
import type { PageStore } from '../app/state';
import type { Frame } from '../engine/protocol';
import type { Vec } from '../engine/game-protocol';
import { Instrument } from './instrument';
import { creakGain, knockGain, pitchOf, rumbleGain, scrapeBand, scrapeGain } from './levels';
import { readSounds, type FrameSounds } from './sounds';
import { Voices } from './voices';
import type { Waves } from './waves';

/** Most of a sound that comes from one side, 0 to 1. */
const SIDE = 0.6;
/** Gestures after which a browser lets a page be heard. */
const GESTURES = ['pointerdown', 'pointerup', 'keydown', 'touchend'] as const;

export class Sound {
  private context: AudioContext | null = null;
  private instrument: Instrument | null = null;
  private readonly voices = new Voices();
  /** Force of the hand over its largest, in the last frame. */
  private strain = 0;
  private knocks = 0;

  /** `side` returns the position on the screen of a point (m): -1 left to 1 right. */
  constructor(
    private readonly store: PageStore,
    private readonly side: (point: Vec) => number,
  ) {
    const unlock = () => this.unlock();
    for (const gesture of GESTURES) window.addEventListener(gesture, unlock, { capture: true });
    store.subscribe(['volume', 'muted'], ({ volume, muted }) => {
      this.instrument?.setVolume(muted ? 0 : volume);
      remember('volume', String(volume));
      remember('muted', String(muted));
    });
    store.subscribe(['paused', 'muted'], ({ paused, muted }) => {
      if (paused || muted) this.silence();
      if (!muted) unlock();
    });
    store.subscribe(['world'], () => this.voices.clear());
    document.addEventListener('visibilitychange', () => {
      if (document.hidden) void this.context?.suspend();
      else void this.context?.resume();
    });
  }

  /** State of the output, `none` until the first gesture, and number of knocks so far. */
  get played(): { state: string; knocks: number } {
    return { state: this.context?.state ?? 'none', knocks: this.knocks };
  }

  /** Plays a frame. */
  receive({ sounds, update, replay }: Frame): void {
    // No frame follows the last of a replay.
    if (replay && replay.frame === replay.frames) this.silence();
    else this.play(sounds, update);
  }

  private play(sounds: Frame['sounds'], update: Frame['update']): void {
    if (!sounds || !this.instrument || this.context?.state !== 'running') return;
    const heard = readSounds(sounds);
    this.playImpacts(heard);
    const slide = heard.slides.reduce((sum, { strength, speed }) => sum + strength * speed, 0);
    this.instrument.scrape(scrapeGain(slide), scrapeBand(heard.slides[0]?.speed ?? 0));
    this.instrument.creak(this.creakOf(update.hand, heard));
  }

  private playImpacts({ impacts }: FrameSounds): void {
    const gains = impacts.map(impact => ({ ...impact, gain: knockGain(impact.strength) }));
    const chosen = this.voices.choose(gains, this.context!.currentTime);
    this.knocks += chosen.length;
    for (const { gain, body, point } of chosen)
      this.instrument!.knock(gain, pitchOf(body), SIDE * Math.max(-1, Math.min(1, this.side(point))));
    const sum = impacts.reduce((total, { strength }) => total + strength, 0);
    this.instrument!.rumble(rumbleGain(sum, impacts.length));
  }

  private creakOf(hand: Frame['update']['hand'], { slides }: FrameSounds): number {
    const before = this.strain;
    this.strain = hand && hand.grip !== 'carry' ? Math.hypot(...hand.force) / this.store.state.maxForce : 0;
    const speed = slides.find(({ body }) => body === hand?.body)?.speed ?? 0;
    return creakGain({ force: this.strain, change: this.strain - before, speed });
  }

  private silence(): void {
    this.instrument?.scrape(0, 1000);
    this.instrument?.creak(0);
    this.instrument?.rumble(0);
  }

  /** Browsers let a page be heard only after a gesture. */
  private unlock(): void {
    if (this.store.state.muted || typeof AudioContext === 'undefined' || !navigator.userActivation?.hasBeenActive)
      return;
    if (!this.context) {
      const context = new AudioContext({ latencyHint: 'interactive' });
      this.context = context;
      void computeWaves(context.sampleRate).then(waves => {
        const { muted, volume } = this.store.state;
        this.instrument = new Instrument(context, muted ? 0 : volume, waves);
      });
    }
    if (this.context.state === 'suspended' && !document.hidden) void this.context.resume();
  }
}

/** Computes the waves at a sample rate (Hz) beside the page. */
function computeWaves(rate: number): Promise<Waves> {
  const worker = new Worker(new URL('./wave-worker.ts', import.meta.url), { type: 'module' });
  worker.postMessage(rate);
  return new Promise(resolve => {
    worker.onmessage = ({ data }: MessageEvent<Waves>) => {
      worker.terminate();
      resolve(data);
    };
  });
}
