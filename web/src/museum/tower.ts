// The tower in the museum: that of 2003, the engine's, or both, with the stage and the hand of the
// game.

import { followGraphics } from '../app/graphics';
import { listenToKeys } from '../app/shortcuts';
import { Stage } from '../app/stage';
import { initialPlay } from '../app/state';
import { Store } from '../app/store';
import type { Options } from '../app/url';
import type { Built } from '../engine/protocol';
import { Hand } from '../hand/hand';
import { Pointers } from '../hand/pointers';
import { text } from '../messages';
import type { RingState } from '../ui/force-ring';
import { Notice, showTrouble } from '../ui/notice';
import { Bodies } from '../view/bodies';
import { pick } from '../view/picking';
import { formatForce, unitOf } from '../view/force-scale';
import { MuseumClient } from './client';
import { ConstantsPanel } from './constants-panel';
import { Controls, readSetup } from './controls';
import { towerDistance } from './distance';
import { Ghost } from '../view/ghost';
import { Hand2003 } from './hand-2003';
import { createTowerInspect, type TowerInspect } from './inspect';
import { Pointers2003 } from './pointers-2003';
import type { ConstantValues, MuseumFrame, MuseumSetup } from './protocol';
import type { MuseumStore } from './state';

/** Factor on the game's distance from the tower: no bars lie over the picture. */
const ZOOM = 0.86;
/** Change of the ghost's poses that is visible, m. */
const VISIBLE = 1e-5;
/** Red of a disabled block, as in the dissertation's Figure 6.22: red, green and blue in sRGB. */
const DISABLED: [number, number, number] = [0.86, 0.14, 0.12];
/** Opacity of that red on the wood. */
const DISABLED_PART = 0.72;
/** Duration of a notice about the tower, s. */
const LONG = 6;

export class Tower {
  readonly inspect: TowerInspect;
  private readonly store: MuseumStore;
  private readonly stage: Stage;
  private readonly ghostView = new Ghost();
  private readonly notice = new Notice();
  private readonly client: MuseumClient;
  private readonly hand: Hand;
  /** The hand of 2003. */
  private readonly oldHand: Hand2003;
  private readonly oldPointers: Pointers2003;
  private readonly controls: Controls;
  private readonly constants: ConstantsPanel;
  private ghost: Bodies | null = null;
  /** Velocity of the fastest block of 2003 in this world, m/s. */
  private maxSpeed = 0;
  /** Blocks that are painted red, as text. */
  private disabled = '';
  /** True once the player has been warned about the block in the hand. */
  private warned = false;

  /** Throws where the browser has no WebGL 2. */
  constructor(options: Options) {
    const setup = readSetup(options);
    const view = { springs: false, oldHand: false, onScreen: true };
    const store: MuseumStore = new Store({ ...initialPlay(options), ...view, setup });
    this.store = store;
    this.stage = new Stage(options, store, ZOOM);
    this.stage.view.add(this.ghostView.group);
    this.client = this.connect();
    this.hand = new Hand(this.client, store, this.stage.orbit, () => this.stage.bodies!);
    this.oldHand = new Hand2003(this.client, this.stage.orbit);
    this.oldPointers = this.listenToOldHand();
    const { stage, hand } = this;
    const frame = () => stage.frame();
    const pointers = new Pointers(stage.canvas, store, hand, stage.orbit, { bodies: () => stage.bodies, frame });
    this.controls = new Controls(store, hand, {
      build: change => this.build(change),
      pause: () => this.togglePause(),
      springs: () => this.toggleSprings(),
      letGo: () => this.letGo(),
    });
    this.constants = new ConstantsPanel(store, values => this.setConstants(values));
    this.subscribe();
    this.listen(frame);
    this.run();
    followGraphics(stage, this.notice);
    this.inspect = createTowerInspect({
      store,
      stage,
      hand,
      pointers,
      oldHand: this.oldHand,
      maxSpeed: () => this.maxSpeed,
    });
  }

  /** Takes whether the tower is on the screen: it is paused while it is not. */
  setOnScreen(onScreen: boolean): void {
    this.store.set({ onScreen });
  }

  setDark(dark: boolean): void {
    this.store.set({ dark });
  }

  private connect(): MuseumClient {
    const worker = new Worker(new URL('./tower-worker.ts', import.meta.url), { type: 'module' });
    return new MuseumClient(worker, {
      scenes: () => this.opened(),
      built: world => this.begin(world),
      frame: frame => this.receive(frame),
      refused: message => this.notice.show(text.museum.tower.refused(message), 8),
      failed: message => showTrouble(text.museum.tower.stopped(message)),
    });
  }

  /** Begins once the worker is ready. */
  private opened(): void {
    this.build({});
    void this.client.constants().then(table => this.constants.begin(table));
  }

  private listenToOldHand(): Pointers2003 {
    const { store, stage } = this;
    const { canvas, orbit } = stage;
    return new Pointers2003(canvas, this.oldHand, orbit, {
      active: () => store.state.oldHand && store.state.setup.show === 'old',
      paused: () => store.state.paused,
      blockAt: (x, y) => stage.bodies && (pick(stage.bodies, orbit.camera.position, orbit.ray(x, y))?.body ?? null),
      centre: body => stage.bodies!.position(body),
      picked: body => {
        canvas.focus({ preventScroll: true, focusVisible: false } as FocusOptions);
        store.set({ hovered: null, selected: body });
      },
    });
  }

  private subscribe(): void {
    const { store, client } = this;
    const pause = () => client.pause(store.state.paused || !store.state.onScreen || document.hidden);
    store.subscribe(['paused', 'onScreen'], pause);
    document.addEventListener('visibilitychange', pause);
    store.subscribe(['selected', 'oldHand'], ({ selected, oldHand }) => {
      // The hand of 2003 has no slots to place a block in.
      client.watch({ springs: true, xray: false, sound: false, selected: oldHand ? null : selected });
    });
    store.subscribe(['paused'], ({ paused }) => {
      if (!paused && this.oldHand.holds) this.oldPointers.resume();
    });
    store.subscribe(['oldHand'], () => this.letGo());
    store.subscribe(['springs'], () => this.stage.view.invalidate());
    store.subscribe(['dark'], ({ dark }) => this.ghostView.setDark(dark));
    store.subscribe(['world'], ({ world, setup }) => {
      if (world) client.command({ command: 'set_hand', can_turn: setup.show !== 'old' });
    });
  }

  private listen(frame: () => void): void {
    const { canvas, orbit } = this.stage;
    listenToKeys(this.store, this.hand, orbit, {
      pause: () => this.togglePause(),
      frame,
      springs: () => this.toggleSprings(),
      // Keys belong to the page unless the tower has the focus.
      busy: () => document.activeElement !== canvas,
    });
    window.addEventListener('keydown', event => {
      if (event.key === 'Escape') this.oldHand.release();
    });
    canvas.addEventListener('pointerdown', () => {
      const options = { preventScroll: true, focusVisible: false };
      canvas.focus(options);
    });
    // The wheel scrolls the page; with the control key, or a block in the hand, it belongs to the
    // tower.
    canvas.parentElement!.addEventListener(
      'wheel',
      event => {
        if (!event.ctrlKey && !event.metaKey && !this.hand.holds) event.stopPropagation();
      },
      { capture: true },
    );
  }

  private run(): void {
    const { store, stage, hand } = this;
    stage.run(hand, {
      visible: () => store.state.onScreen,
      springs: () => store.state.springs,
      holders: () => hand.holders()?.bodies ?? [],
      ring: state => this.ring(state),
      blend: t => this.moveGhost(t),
      readout: () => this.readout(),
    });
  }

  private letGo(): void {
    this.hand.letGo();
    this.oldHand.release();
  }

  /** Sets constants of the standing tower; returns null, or why they are not accepted. */
  private async setConstants(values: ConstantValues): Promise<string | null> {
    const refused = await this.client.setConstants(values);
    const { setup } = this.store.state;
    if (refused === null) this.store.set({ setup: { ...setup, constants: { ...setup.constants, ...values } } });
    return refused;
  }

  private build(change: Partial<MuseumSetup>): void {
    this.hand.letGo();
    this.oldHand.reset();
    const setup = { ...this.store.state.setup, ...change };
    const springs = this.store.state.springs && setup.show === 'old';
    this.store.set({ setup, springs, paused: false });
    this.client.build(setup);
  }

  private begin(world: Built): void {
    this.stage.begin(world);
    const both = this.store.state.setup.show === 'both';
    this.ghost = both ? new Bodies(world.sizes, world.poses.slice(), world.particleOffset) : null;
    this.ghostView.hide();
    this.warned = false;
    this.disabled = '';
    this.maxSpeed = 0;
    this.store.set({ world, frame: null, selected: null });
  }

  private receive(frame: MuseumFrame): void {
    if (!this.store.state.world) return;
    this.stage.receive(frame);
    if (frame.ghost) this.ghost?.arrive(frame.ghost.poses, frame.ghost.lattices);
    const stood = this.store.state.frame?.update.tower !== 'fallen';
    this.store.set({ frame });
    this.maxSpeed = Math.max(this.maxSpeed, frame.old?.max_speed ?? 0);
    this.hand.receive(frame);
    this.showDisabled();
    if (!frame.update.hand) this.warned = false;
    else this.warn();
    const both = this.store.state.setup.show === 'both';
    if (stood && frame.update.tower === 'fallen')
      this.notice.show(both ? text.museum.tower.enginesFell : text.museum.tower.towerFell, LONG);
  }

  /** Says once per grasp that a carried block fits no slot. */
  private warn(): void {
    const { hand } = this;
    const { show } = this.store.state.setup;
    if (show !== 'old' || !hand.carries || this.warned || hand.slots.length > 0) return;
    this.warned = true;
    this.notice.show(text.museum.tower.fits, LONG);
  }

  /** Paints the disabled blocks of the tower of 2003 red. */
  private showDisabled(): void {
    const { frame, setup } = this.store.state;
    const disabled = new Set(setup.show === 'old' ? frame?.old?.disabled : []);
    const key = [...disabled].join();
    if (key === this.disabled) return;
    this.disabled = key;
    const count = this.stage.bodies?.count ?? 0;
    const colours = Array.from({ length: count }, (_, body) => (disabled.has(body) ? DISABLED : null));
    this.stage.view.stain(colours, DISABLED_PART);
  }

  private togglePause(): void {
    this.store.set({ paused: !this.store.state.paused });
  }

  private toggleSprings(): void {
    const { springs, setup } = this.store.state;
    this.store.set({ springs: !springs && setup.show === 'old' });
  }

  /** In the air the hand of 2003 has no force, which the note explains. */
  private ring(state: RingState | null): RingState | null {
    const { setup, frame } = this.store.state;
    const force = frame?.update.hand?.force;
    const writes = setup.show === 'old' && force?.every(f => f === 0);
    return state && writes ? { ...state, note: text.museum.tower.velocity } : state;
  }

  private moveGhost(t: number): boolean {
    const { ghost, ghostView, stage } = this;
    if (!stage.bodies || !ghost || !this.store.state.frame?.ghost) return false;
    const changed = ghost.blend(t) > VISIBLE || !ghostView.group.visible;
    if (changed) ghostView.show(ghost, towerDistance(stage.bodies.shown, ghost.shown).each);
    return changed;
  }

  private readout(): void {
    const { frame, springs } = this.store.state;
    const { hand, controls, stage } = this;
    controls.showHand(hand.canPlace(), hand.holds || this.oldHand.holds, hand.carries);
    if (!frame || !stage.bodies) return;
    const unit = unitOf(stage.forces.end);
    controls.showReadouts({
      frame,
      fps: stage.fps,
      distance: frame.ghost && towerDistance(frame.poses, frame.ghost.poses),
      blocks: stage.bodies.count,
      springs: springs ? text.museum.tower.upTo(`${formatForce(stage.forces.end, unit)} ${unit}`) : '',
    });
  }
}
