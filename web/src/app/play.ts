// Ties the game in the worker to the page: builds worlds, sends commands, and takes what the worker
// sends.

import { Client } from '../engine/client';
import type { Form, HandUpdate, Update } from '../engine/game-protocol';
import type { Built, Deliberation, Frame, SceneEntry, Setup, XRay } from '../engine/protocol';
import { Hand } from '../hand/hand';
import { text } from '../messages';
import { games } from '../messages';
import { modeOf } from '../modes';
import { computersOf, rulesOf, type Match } from '../modes/match';
import type { Mode, ModeUi } from '../modes/mode';
import { Sound } from '../sound/sound';
import { Pool } from '../study/pool';
import { Thinker } from '../study/thinker';
import { showTrouble, type Notice } from '../ui/notice';
import { Delays } from './delays';
import { enginesAddress } from './engines';
import { followGraphics } from './graphics';
import { SlowMotion } from './slow-motion';
import type { Stage } from './stage';
import { setupOf, type PageStore, type Settings } from './state';

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
  /** Workers beside the game. */
  readonly pool = new Pool();
  private readonly thinker: Thinker;
  /** Scene of a challenge (JSON). */
  private scene: string | null = null;
  private opening: () => Promise<boolean> = async () => false;

  /** `xray` takes the X-ray of a tower at rest. */
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly notice: Notice,
    private readonly xray: (xray: XRay) => void,
  ) {
    this.delays = new Delays(notice);
    this.thinker = new Thinker(this.pool, part => store.set({ thinking: part < 1 ? part : null }));
    this.delays.begin('engine');
    this.client = new Client(new Worker(new URL('../engine/worker.ts', import.meta.url), { type: 'module' }), {
      scenes: list => this.listScenes(list),
      built: world => this.begin(world),
      frame: frame => this.receive(frame),
      xray: xray => this.xray(xray),
      deliberation: deliberation => void this.think(deliberation),
      refused: message => {
        this.awaitStep();
        if (!store.state.world) this.build();
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

  /** Mode that is played. */
  get mode(): Mode {
    return modeOf(this.store.state.match.mode);
  }

  /**
   * Starts what depends on the state of the page. `opening` requests the first world, or returns
   * false for that of the settings.
   */
  start(opening: () => Promise<boolean>): void {
    this.opening = opening;
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
      const { canTurn: can_turn } = this.mode.rules();
      if (world) client.command({ command: 'set_hand', can_turn });
    });
    store.subscribe(['speed'], ({ speed }) => client.setSpeed(speed));
  }

  /** Changes settings; they count from the next build. */
  change(change: Partial<Settings>): void {
    this.store.set({ settings: { ...this.store.state.settings, ...change } });
  }

  /** Builds the world of the settings, and begins the next game of the match. */
  build(): void {
    const { settings, match } = this.store.state;
    if (match.mode === 'challenge' && this.scene !== null) return this.beginsOn(this.scene, match);
    this.request(setupOf(settings, rulesOf(match, settings.seed), computersOf(match, settings.seed)));
  }

  /** Goes on with a recorded game where it ended. */
  resume(bytes: Uint8Array, match: Match, settings = this.store.state.settings): void {
    this.store.set({ match, settings });
    const computers = computersOf(match, settings.seed);
    this.request({ ...setupOf(settings, null, computers), source: { kind: 'record', bytes } });
  }

  /** Begins a match on a scene (JSON). */
  beginsOn(scene: string, match: Match): void {
    this.store.set({ match });
    this.scene = scene;
    const rules = rulesOf(match, this.store.state.settings.seed);
    this.request({ ...setupOf(this.store.state.settings, rules), source: { kind: 'scene', text: scene } });
  }

  /** Plays a recorded game again. */
  replay(bytes: Uint8Array, match: Match): void {
    this.store.set({ match });
    this.request({
      ...setupOf(this.store.state.settings),
      source: { kind: 'replay', bytes, engines: enginesAddress() },
    });
  }

  /** Begins a match. */
  begins(match: Match, change: Partial<Settings> = {}): void {
    this.store.set({ match });
    this.change(change);
    this.build();
  }

  /** Begins the next game of the match, on a tower of other blocks. */
  again(): void {
    this.rebuild({ seed: this.store.state.settings.seed + 1 });
  }

  private request(setup: Setup): void {
    this.hand.letGo();
    this.delays.begin('world');
    this.client.build(setup);
  }

  /**
   * Changes settings and builds their world. A scene that is no tower is played freely, and another
   * tower than that of the day alone.
   */
  rebuild(change: Partial<Settings>): void {
    const { match } = this.store.state;
    const mode = change.scene ? 'free' : match.mode === 'daily' || match.mode === 'challenge' ? 'solo' : null;
    const isReplay = match.mode === 'replay';
    this.begins(mode || isReplay ? modeOf(mode).match() : match, change);
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
    void this.opening().then(opened => opened || this.build());
  }

  private setBlocks(form: Form): void {
    const { springs } = this.store.state.settings;
    this.client.command({ command: 'set_blocks', form, spring_stiffness: springs });
  }

  private begin(world: Built): void {
    this.stage.begin(world);
    this.slowMotion.reset();
    const maxForce = Math.min(this.store.state.maxForce, world.rules?.max_force ?? Infinity);
    // A game that goes on may have a block in the hand: it waits until that is known.
    this.store.set({ maxForce, frame: null, selected: null, paused: world.resumed, speed: 1, safest: null });
    this.store.set({ world, form: world.form });
    this.awaitStep();
  }

  private receive(frame: Frame): void {
    const { store, mode } = this;
    const { update } = frame;
    if (!store.state.world) return;
    const { match, speed } = store.state;
    const resumes = store.state.world.resumed && store.state.frame === null;
    this.awaitStep();
    this.stage.receive(frame);
    this.reportQuarantined(update);
    store.set({ frame, watching: this.watches(update) });
    const isNext = update.events.some(({ event }) => event === 'turn_started' || event === 'removed');
    if (isNext && store.state.safest) store.set({ safest: null });
    // The end of a replay is no delay.
    if (frame.replay && frame.replay.frame === frame.replay.frames) this.delays.end();
    // The form changes only by a command; the device's choice then no longer counts.
    if (update.form !== store.state.form.value) store.set({ form: { value: update.form, chosen: false } });
    if (resumes) this.goOn(update.hand);
    this.hand.receive(frame);
    this.sound.receive(frame);
    for (const event of update.events) mode.onEvent(event, this.modeUi, match);
    for (const command of mode.commands?.(update) ?? []) this.client.command(command);
    if (this.slowMotion.begins(frame.factor / speed)) this.notice.show(text.notices.slow(frame.factor));
  }

  /** Answers the question of a computer player. */
  private async think(deliberation: Deliberation): Promise<void> {
    const moves = await this.thinker.answer(deliberation);
    this.client.decide(deliberation, JSON.stringify(moves));
  }

  /** Goes on with a resumed game, or waits for the player to take over the block in the hand. */
  private goOn(hand: HandUpdate | null): void {
    if (hand) this.hand.adopt(hand);
    if (this.hand.holds) this.notice.show(games.records.resumedHolding, LONG);
    else this.store.set({ paused: false });
  }

  /** True where the player only watches. */
  private watches({ turn }: Update): boolean {
    const { players } = this.store.state.match;
    return this.mode.watches === true || (turn !== undefined && players[turn.player]?.strength !== null);
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
