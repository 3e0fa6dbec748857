// The bar of a replay: play, scrub, speed, and what to do with the record.

import type { Play } from '../app/play';
import type { PageState, PageStore } from '../app/state';
import { FRAME } from '../engine/game-protocol';
import { games } from '../messages';
import { create, element, icon, setText } from '../ui/dom';

const SPEEDS = [0.25, 0.5, 1, 2, 4];

export interface ReplayActions {
  /** Begins a game on the tower at the start of the record. */
  challenge(): void;
  save(): void;
  close(): void;
}

export class ReplayBar {
  private readonly bar = create('section', { id: 'replay', 'aria-label': games.modes.replay.name, hidden: true });
  private readonly toggle = create('button', { id: 'replay-toggle' });
  private readonly scrub = create('input', { id: 'replay-scrub', type: 'range', min: 0, step: 1 });
  private readonly time = create('output', { id: 'replay-time' });
  private readonly speed = create('select', { id: 'replay-speed', 'aria-label': games.replay.speed });
  private readonly note = create('p', { id: 'replay-note', hidden: true }, games.replay.unchecked);
  private scrubbing = false;

  constructor(
    private readonly store: PageStore,
    private readonly play: Play,
    actions: ReplayActions,
  ) {
    this.scrub.setAttribute('aria-label', games.replay.scrub);
    this.speed.append(...SPEEDS.map(speed => new Option(`${speed}×`, String(speed), speed === 1, speed === 1)));
    const button = (id: string, symbol: string, label: string, action: () => void) => {
      const node = create('button', { id, title: label, 'aria-label': label }, icon(symbol));
      node.addEventListener('click', action);
      return node;
    };
    this.bar.append(
      this.toggle,
      this.scrub,
      this.time,
      this.speed,
      this.challengeButton(() => actions.challenge()),
      button('replay-save', 'i-file', games.replay.save, () => actions.save()),
      button('replay-close', 'i-close', games.replay.close, () => actions.close()),
      this.note,
    );
    element('stage').after(this.bar);
    this.listen();
    store.subscribe(['world'], ({ world }) => this.begin(world?.frames ?? null));
    store.subscribe(['frame', 'paused'], state => this.show(state));
    store.subscribe(['speed'], ({ speed }) => (this.speed.value = String(speed)));
  }

  private challengeButton(action: () => void): HTMLElement {
    const node = create('button', { id: 'replay-challenge', class: 'plain', title: games.replay.challenge });
    node.textContent = games.replay.beat;
    node.addEventListener('click', action);
    return node;
  }

  private listen(): void {
    const { store, play, scrub } = this;
    this.toggle.addEventListener('click', () => {
      if (this.isAtEnd) {
        play.client.seek(0);
        store.set({ paused: false });
      } else play.togglePause();
    });
    scrub.addEventListener('input', () => {
      this.scrubbing = true;
      play.client.seek(Number(scrub.value));
    });
    scrub.addEventListener('change', () => (this.scrubbing = false));
    this.speed.addEventListener('change', () => store.set({ speed: Number(this.speed.value) }));
  }

  private get isAtEnd(): boolean {
    const replay = this.store.state.frame?.replay;
    return replay != null && replay.frame === replay.frames;
  }

  private begin(frames: number | null): void {
    this.bar.hidden = frames === null;
    document.body.classList.toggle('replays', frames !== null);
    if (frames !== null) this.scrub.max = String(frames);
  }

  private show({ frame, paused }: Readonly<PageState>): void {
    const replay = frame?.replay;
    if (!replay) return;
    this.note.hidden = replay.engine !== 'missing';
    if (!this.scrubbing) this.scrub.value = String(replay.frame);
    const { minutes } = games.end;
    setText(this.time, `${minutes(replay.frame * FRAME)} / ${minutes(replay.frames * FRAME)}`);
    const stands = paused || this.isAtEnd;
    const label = stands ? games.replay.play : games.replay.pause;
    if (this.toggle.title === label) return;
    this.toggle.title = label;
    this.toggle.setAttribute('aria-label', label);
    this.toggle.replaceChildren(icon(stands ? 'i-play' : 'i-pause'));
  }
}
