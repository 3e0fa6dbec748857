// The bar under a motion: play, and its time.

import { games } from '../messages';
import { create, setText } from '../ui/dom';

const PATHS = { play: 'M7 4.5v15l12-7.5z', pause: 'M8 5v14M16 5v14' };

export interface ScrubberActions {
  toggle(): void;
  /** Goes to a frame. */
  seek(frame: number): void;
}

export class Scrubber {
  readonly element = create('div', { class: 'teeter-bar' });
  private readonly button = create('button', { type: 'button' });
  private readonly slider = create('input', { type: 'range', min: 0, step: 'any', 'aria-label': games.replay.scrub });
  private readonly time = create('output');
  private readonly path = document.createElementNS('http://www.w3.org/2000/svg', 'path');

  constructor(actions: ScrubberActions) {
    const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    svg.setAttribute('viewBox', '0 0 24 24');
    svg.setAttribute('aria-hidden', 'true');
    svg.append(this.path);
    this.button.append(svg);
    this.button.addEventListener('click', () => actions.toggle());
    this.slider.addEventListener('input', () => actions.seek(Number(this.slider.value)));
    this.slider.addEventListener('keydown', event => this.key(event, actions));
    this.element.append(this.button, this.slider, this.time);
  }

  /** Shows a frame of so many states, `interval` seconds apart. */
  show(frame: number, states: number, interval: number, playing: boolean): void {
    this.element.hidden = states < 2;
    this.slider.max = String(states - 1);
    if (Number(this.slider.value) !== frame) this.slider.value = String(frame);
    const { minutes } = games.end;
    const total = (states - 1) * interval;
    const text = total < 60 ? `${(frame * interval).toFixed(1)} s` : minutes(frame * interval);
    setText(this.time, text);
    this.slider.setAttribute('aria-valuetext', text);
    const label = playing ? games.replay.pause : games.replay.play;
    this.button.title = label;
    this.button.setAttribute('aria-label', label);
    this.path.setAttribute('d', playing ? PATHS.pause : PATHS.play);
  }

  /** A step of `any` has no arrow keys of its own: they go from state to state. */
  private key(event: KeyboardEvent, { seek, toggle }: ScrubberActions): void {
    const [at, end] = [Number(this.slider.value), Number(this.slider.max)];
    const goal: Record<string, number> = {
      ArrowRight: Math.floor(at + 1),
      ArrowLeft: Math.ceil(at - 1),
      Home: 0,
      End: end,
    };
    if (event.key === ' ') toggle();
    else if (event.key in goal) seek(Math.min(end, Math.max(0, goal[event.key])));
    else return;
    event.preventDefault();
  }
}
