// Ties the game in the worker to the page: builds worlds, sends commands, and takes what the worker
// sends.

import { Client } from '../engine/client';
import type { Form, Update } from '../engine/game-protocol';
import type { Built, Frame, SceneEntry, XRay } from '../engine/protocol';
import { Hand } from '../hand/hand';
import { text } from '../messages';
import type { Mode, ModeUi } from '../modes/mode';
import { Sound } from '../sound/sound';
import { showTrouble, type Notice } from '../ui/notice';
import { Delays } from './delays';
import { followGraphics } from './graphics';
import { SlowMotion } from './slow-motion';
import type { Stage } from './stage';
import { setupOf, type PageStore, type Settings } from './state';
import type { Options } from './url';

/** Duration of a notice that reports an error, s. */
const LONG = 8;
/** Listed scenes that the tower's own settings cover. */
const COVERED = ['tower', 'official'];

export class Play {
  readonly client: Client;
  readonly hand: Hand;
  readonly sound: Sound;
  private readonly slowMotion = new SlowMotion();
  private readonly delays: Delays;
  private readonly modeUi: ModeUi;

  /** `xray` takes the X-ray of a tower at rest. */
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly mode: Mode,
    private readonly notice: Notice,
    private readonly xray: (xray: XRay) => void,
  ) {
    this.delays = new Delays(notice);
    this.delays.begin('engine');
    this.client = new Client(new Worker(new URL('../engine/worker.ts', import.meta.url), { type: 'module' }), {
      scenes: list => this.listScenes(list),
      built: world => this.begin(world),
      frame: frame => this.receive(frame),
      xray: xray => this.xray(xray),
      refused: message => {
        this.awaitStep();
        notice.show(text.notices.refused(message), LONG);
      },
      failed: message => {
        this.delays.end();
        showTrouble(text.trouble.stopped(message));
      },
    });
    this.hand = new Hand(this.client, store, stage.orbit, () => stage.bodies!);
    this.sound = new Sound(store, point => stage.sideOf(point));
    this.modeUi = {
      notice: (line, seconds) => notice.show(line, seconds),
      contacts: body => this.client.ask({ what: 'contacts', body }),
    };
  }

  /** Starts what depends on the state of the page. */
  start(options: Options): void {
    const { store, client } = this;
    followGraphics(this.stage, this.notice);
    const pause = () => {
      client.pause(this.isPaused());
      // What the engine loads or builds is awaited all the same.
      if (store.state.world) this.awaitStep();
    };
    store.subscribe(['paused'], pause);
    document.addEventListener('visibilitychange', pause);
    // Before its first world the worker may not listen yet.
    store.subscribe(['world', 'overlay', 'selected', 'muted'], ({ overlay, selected, muted }) => {
      client.watch({ springs: overlay === 'springs', xray: overlay === 'xray', sound: !muted, selected });
    });
    store.subscribe(['overlay'], () => this.stage.view.invalidate());
    store.subscribe(['world'], ({ world }) => {
      const { canTurn: can_turn } = this.mode.rules(options);
      if (world) client.command({ command: 'set_hand', can_turn });
    });
  }

  /** Changes settings; they count from the next build. */
  change(change: Partial<Settings>): void {
    this.store.set({ settings: { ...this.store.state.settings, ...change } });
  }

  /** Builds the world of the settings. */
  build(): void {
    this.hand.letGo();
    this.delays.begin('world');
    this.client.build(setupOf(this.store.state.settings));
  }

  /** Changes settings and builds their world. */
  rebuild(change: Partial<Settings>): void {
    this.change(change);
    this.build();
  }

  /**
   * Changes the blocks of the standing tower as well; without a form the device chooses it for a
   * new tower.
   */
  setForm(form: Form | null): void {
    if (!form) return this.rebuild({ form });
    this.change({ form });
    this.setBlocks(form);
  }

  /** Changes the springs inside the blocks, N/m; null for springs as stiff as the contacts. */
  setSprings(springs: number | null): void {
    this.change({ springs });
    this.setBlocks('lattice');
  }

  togglePause(): void {
    const paused = !this.store.state.paused;
    this.store.set({ paused });
    if (paused && this.hand.holds) this.notice.show(text.notices.paused);
  }

  private listScenes(list: SceneEntry[]): void {
    const scenes = list.filter(entry => !COVERED.includes(entry.name));
    this.store.set({ scenes });
    if (!scenes.some(entry => entry.name === this.store.state.settings.scene)) this.change({ scene: null });
    this.build();
  }

  private setBlocks(form: Form): void {
    const { springs } = this.store.state.settings;
    this.client.command({ command: 'set_blocks', form, spring_stiffness: springs });
  }

  private begin(world: Built): void {
    this.stage.begin(world);
    this.slowMotion.reset();
    this.store.set({ world, frame: null, form: world.form, selected: null, paused: false });
    this.awaitStep();
  }

  private receive(frame: Frame): void {
    const { store, mode } = this;
    const { update } = frame;
    if (!store.state.world) return;
    this.awaitStep();
    this.stage.receive(frame);
    this.reportQuarantined(update);
    store.set({ frame });
    // The form changes only by a command; the device's choice then no longer counts.
    if (update.form !== store.state.form.value) store.set({ form: { value: update.form, chosen: false } });
    this.hand.receive(frame);
    this.sound.receive(frame);
    for (const event of update.events) mode.onEvent(event, this.modeUi);
    for (const command of mode.commands?.(update) ?? []) this.client.command(command);
    if (this.slowMotion.begins(frame.factor)) this.notice.show(text.notices.slow(frame.factor));
  }

  private isPaused(): boolean {
    return this.store.state.paused || document.hidden;
  }

  /** Begins to wait for the next step, of which there is none without a world or in a pause. */
  private awaitStep(): void {
    if (!this.store.state.world || this.isPaused()) this.delays.end();
    else this.delays.begin('step');
  }

  private reportQuarantined({ report }: Update): void {
    for (const body of report.quarantined) this.notice.show(text.notices.frozen(body), LONG);
  }
}
