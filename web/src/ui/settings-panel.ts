// The panel of settings. Its controls show the store, and change it.

import type { Play } from '../app/play';
import type { PageState, PageStore, Settings } from '../app/state';
import { MAX_FORCE, ROWS, SEED, type Options } from '../app/url';
import { STIFFNESSES } from '../engine/device';
import type { Form } from '../engine/game-protocol';
import type { BlockPreset, SceneEntry } from '../engine/protocol';
import { capitalized, element, onClick, setText } from './dom';
import { newtonsPerMillimetre, SpringsDial } from './springs-dial';

/** Largest random seed. */
const MAX_RANDOM_SEED = 99_999;

const FORMS: Record<Form, string> = { rigid: 'Rigid', lattice: 'Springs inside' };

export class SettingsPanel {
  private readonly panel = element('panel');
  private readonly scene = element<HTMLSelectElement>('scene');
  private readonly rows = element<HTMLInputElement>('rows');
  private readonly block = element<HTMLSelectElement>('block');
  private readonly seed = element<HTMLInputElement>('seed');
  private readonly maxForce = element<HTMLInputElement>('cap');
  private readonly stiffness = element<HTMLSelectElement>('stiffness');
  private readonly form = element<HTMLSelectElement>('form');
  private readonly showSprings = element<HTMLInputElement>('show-springs');
  private readonly sleep = element<HTMLInputElement>('sleep');
  private readonly toggle = element<HTMLButtonElement>('settings');
  private readonly dial: SpringsDial;

  constructor(
    private readonly store: PageStore,
    private readonly play: Play,
    options: Options,
  ) {
    this.dial = new SpringsDial(springs => play.setSprings(springs));
    setRange(this.rows, ROWS);
    setRange(this.maxForce, MAX_FORCE);
    this.listStiffnesses(options.stiffness);
    store.subscribe(['scenes'], ({ scenes }) => this.listScenes(scenes));
    store.subscribe(['settings'], ({ settings }) => this.showSettings(settings));
    store.subscribe(['maxForce'], ({ maxForce }) => {
      this.maxForce.value = String(maxForce);
      setText('cap-value', `${maxForce.toFixed(1)} N`);
    });
    store.subscribe(['overlay'], ({ overlay }) => (this.showSprings.checked = overlay === 'springs'));
    store.subscribe(['world', 'form', 'settings'], state => this.showWorld(state));
    store.subscribe(['panelOpen'], ({ panelOpen }) => {
      this.panel.hidden = !panelOpen;
      this.toggle.setAttribute('aria-expanded', String(panelOpen));
    });
    this.listenToTower();
    this.listenToBlocks();
    this.listenToPanel();
  }

  private listenToTower(): void {
    const { play, rows, seed, block, scene } = this;
    rows.addEventListener('input', () => setText('rows-value', rows.value));
    rows.addEventListener('change', () => play.rebuild({ rows: Number(rows.value) }));
    block.addEventListener('change', () => play.rebuild({ block: block.value as BlockPreset }));
    scene.addEventListener('change', () => play.rebuild({ scene: scene.value || null }));
    seed.addEventListener('change', () => {
      const value = Math.round(Number(seed.value));
      play.rebuild({ seed: Number.isFinite(value) ? Math.min(SEED.max, Math.max(SEED.min, value)) : 1 });
      // A value out of range leaves the setting as it was.
      seed.value = String(this.store.state.settings.seed);
    });
    onClick('new-seed', () => play.rebuild({ seed: 1 + Math.floor(Math.random() * MAX_RANDOM_SEED) }));
  }

  private listenToBlocks(): void {
    const { play, form, stiffness, sleep } = this;
    form.addEventListener('change', () => play.setForm((form.value || null) as Form | null));
    stiffness.addEventListener('change', () => play.rebuild({ stiffness: Number(stiffness.value) || null }));
    sleep.addEventListener('change', () => play.rebuild({ sleep: sleep.checked }));
  }

  private listenToPanel(): void {
    const { store, showSprings, maxForce } = this;
    maxForce.addEventListener('input', () => store.set({ maxForce: Number(maxForce.value) }));
    showSprings.addEventListener('change', () => store.set({ overlay: showSprings.checked ? 'springs' : 'none' }));
    const open = (panelOpen: boolean) => {
      store.set({ panelOpen });
      if (!panelOpen) this.toggle.focus({ preventScroll: true });
    };
    this.toggle.addEventListener('click', () => open(!store.state.panelOpen));
    onClick('panel-close', () => open(false));
  }

  private showSettings({ scene, rows, seed, block, sleep, stiffness, form }: Settings): void {
    this.scene.value = scene ?? '';
    this.rows.value = String(rows);
    this.seed.value = String(seed);
    this.block.value = block;
    this.sleep.checked = sleep;
    this.stiffness.value = stiffness === null ? '' : String(stiffness);
    this.form.value = form ?? '';
    setText('rows-value', String(rows));
    element('tower-fields').hidden = scene !== null;
  }

  /** Shows what was chosen for the device, and the springs of the tower. */
  private showWorld({ world, form, settings }: Readonly<PageState>): void {
    if (!world) return;
    const { stiffness } = world;
    const value = newtonsPerMillimetre(stiffness.value);
    setText('stiffness-value', stiffness.chosen ? `${value}, chosen for this device.` : '');
    setText('form-value', form.chosen ? `${FORMS[form.value]}, chosen for this device.` : '');
    this.dial.show(form.value === 'lattice', settings.springs, stiffness.value);
  }

  private listScenes(list: SceneEntry[]): void {
    this.scene.replaceChildren(new Option('Tower', ''), ...list.map(e => new Option(capitalized(e.title), e.name)));
    this.scene.value = this.store.state.settings.scene ?? '';
  }

  /** Lists the stiffnesses that the device chooses from, and the one in the address. */
  private listStiffnesses(named: number | null): void {
    const all =
      named === null || STIFFNESSES.includes(named) ? STIFFNESSES : [...STIFFNESSES, named].sort((a, b) => a - b);
    this.stiffness.append(...all.map(k => new Option(newtonsPerMillimetre(k), String(k))));
  }
}

function setRange(input: HTMLInputElement, { min, max }: { min: number; max: number }): void {
  input.min = String(min);
  input.max = String(max);
}
