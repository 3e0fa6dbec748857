// The widget of notebooks (anywidget): a tower, its motion, and its X-ray. Python sends poses, so
// it needs no physics.

import { text } from '../messages';
import { create, setText } from '../ui/dom';
import { describe } from '../xray/appearance';
import { isLoose, readings, type Reading } from '../xray/readings';
import { fillScale } from '../xray/scale';
import { Camera } from './camera';
import { floats, follow, type Model } from './model';
import { Motion } from './motion';
import styles from './notebook.css?inline';
import { Picture } from './picture';
import { Scrubber } from './scrubber';

/** Time between two messages to Python while a motion plays, s. */
const MESSAGE_INTERVAL = 0.25;

class Widget {
  readonly element = create('div', { class: 'teeter-view', 'data-lm-suppress-shortcuts': 'true' });
  private readonly canvas = create('canvas', { tabindex: 0, role: 'img', 'aria-label': text.notebook.picture });
  private readonly caption = create('div', { role: 'status' });
  private readonly scale = scale();
  private readonly scrubber: Scrubber;
  private readonly picture: Picture;
  private motion = new Motion(new Float32Array(), 0);
  private readings: Reading[] | null = null;
  private sentAt = 0;
  /** Frame in which this view left the model. */
  private left = -1;
  private readonly ends: (() => void)[];

  constructor(private readonly model: Model) {
    const labels = create('div', { class: 'teeter-figures', hidden: true });
    this.scrubber = new Scrubber({ toggle: () => this.toggle(), seek: frame => this.seek(frame) });
    const words = create('div', { class: 'teeter-text' }, this.caption, this.scale);
    this.element.append(this.canvas, labels, words, this.scrubber.element);
    this.picture = new Picture(this.canvas, labels);
    this.picture.advance = elapsed => this.advance(elapsed);
    new Camera(this.picture, body => this.select(body));
    this.ends = [
      follow(model, ['sizes'], () => this.begin()),
      follow(model, ['poses'], () => this.receive()),
      follow(model, ['readings'], () => this.showXRay()),
      follow(model, ['selected'], () => this.showSelected()),
      follow(model, ['height'], () => this.setHeight()),
      follow(model, ['frame', 'playing', 'interval'], () => this.showTime()),
    ];
    this.setHeight();
    this.begin();
  }

  dispose(): void {
    for (const end of this.ends) end();
    this.picture.dispose();
  }

  private setHeight(): void {
    this.canvas.style.height = `${this.model.get('height')}px`;
  }

  private begin(): void {
    const sizes = floats(this.model.get('sizes'));
    this.motion = new Motion(floats(this.model.get('poses')), sizes.length / 3);
    if (this.motion.states === 0) return;
    this.picture.begin(sizes, this.motion.state(0));
    this.motion.show(this.frame, this.picture.bodies!);
    this.showXRay();
    this.showSelected();
    this.showTime();
  }

  /** Takes new poses. Those of other blocks come with their sizes, which begin again. */
  private receive(): void {
    const { bodies } = this.picture;
    const poses = floats(this.model.get('poses'));
    if (!bodies || poses.length % bodies.shown.length !== 0) return;
    this.motion = new Motion(poses, bodies.count);
    this.showTime();
  }

  private get frame(): number {
    return this.motion.within(this.model.get('frame'));
  }

  /** Moves a playing motion on, and shows its frame. */
  private advance(elapsed: number) {
    const { model, picture, motion } = this;
    let playing = model.get('playing');
    // Where two views of a model play, the first one moves it on.
    const drives = model.get('frame') === this.left;
    if (playing && elapsed > 0 && drives) {
      const frame = motion.within(this.frame + elapsed / model.get('interval'));
      model.set('frame', frame);
      this.sentAt += elapsed;
      if (frame >= motion.states - 1) {
        model.set('playing', false);
        playing = false;
      }
      if (!playing || this.sentAt > MESSAGE_INTERVAL) {
        this.sentAt = 0;
        model.save_changes();
      }
    }
    this.left = model.get('frame');
    this.scrubber.show(this.frame, motion.states, model.get('interval'), playing);
    return { change: motion.states > 0 ? motion.show(this.frame, picture.bodies!) : 0, goesOn: playing };
  }

  private toggle(): void {
    const playing = !this.model.get('playing');
    if (playing && this.frame >= this.motion.states - 1) this.model.set('frame', 0);
    this.model.set('playing', playing);
    this.model.save_changes();
    this.picture.request();
  }

  private seek(frame: number): void {
    this.model.set('frame', frame);
    this.model.save_changes();
    this.picture.request();
  }

  private showTime(): void {
    this.scrubber.show(this.frame, this.motion.states, this.model.get('interval'), this.model.get('playing'));
    this.picture.request();
  }

  private showXRay(): void {
    const { bodies } = this.picture;
    const forces = floats(this.model.get('readings'));
    this.readings = bodies && forces.length === 2 * bodies.count ? readings(forces, bodies) : null;
    this.picture.xray(this.readings);
    this.scale.hidden = this.readings === null;
    this.showCaption();
  }

  private select(body: number | null): void {
    this.model.set('selected', body ?? -1);
    this.model.save_changes();
    this.showSelected();
  }

  private showSelected(): void {
    const body = this.model.get('selected');
    const { bodies } = this.picture;
    this.picture.select(bodies && body >= 0 && body < bodies.count ? body : null);
    this.showCaption();
  }

  private showCaption(): void {
    const { readings } = this;
    const reading = readings?.[this.model.get('selected')];
    const loose = readings ? text.xray.loose(readings.filter(isLoose).length, readings.length) : '';
    setText(this.caption, reading ? describe(this.model.get('selected'), reading) : loose);
  }
}

/** Creates the legend of the X-ray's colours. */
function scale(): HTMLElement {
  const bar = create('div', { class: 'teeter-scale-bar' });
  const ticks = create('div', { class: 'teeter-scale-ticks' });
  fillScale(bar, ticks);
  const words = create('div', {}, text.xray.scale);
  return create('div', { class: 'teeter-scale', role: 'group', 'aria-label': text.xray.label }, words, bar, ticks);
}

/** Renders a view of a model into an element; returns a function that ends it. */
function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  el.append(create('style', {}, styles));
  try {
    const widget = new Widget(model);
    el.append(widget.element);
    return () => widget.dispose();
  } catch (error) {
    console.error(error);
    el.append(create('p', {}, text.notebook.noWebGl));
    return () => {};
  }
}

export default { render };
