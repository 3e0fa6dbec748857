// The panel of settings. Its controls show the store, and change it.

import { remember } from '../app/memory';
import type { Play } from '../app/play';
import type { PageState, PageStore, Settings } from '../app/state';
import { MAX_FORCE, ROWS, SEED, type Options } from '../app/url';
import { STIFFNESSES } from '../engine/device';
import type { Form } from '../engine/game-protocol';
import type { BlockPreset, SceneEntry } from '../engine/protocol';
import { canVibrate } from '../hand/haptics';
import { language, text } from '../messages';
import { chooseLanguage, LANGUAGES } from '../messages/languages';
import { capitalized, element, onClick, setText } from './dom';
import { newtonsPerMillimetre, SpringsDial } from './springs-dial';

/** Largest random seed. */
const MAX_RANDOM_SEED = 99_999;

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
    listLanguages();
    store.subscribe(['scenes'], ({ scenes }) => this.listScenes(scenes));
    store.subscribe(['settings'], ({ settings }) => this.showSettings(settings));
    store.subscribe(['maxForce'], ({ maxForce }) => {
      this.maxForce.value = String(maxForce);
      setText('cap-value', text.readouts.newtons(maxForce, 1));
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
    this.listenToVibration();
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

  private listenToVibration(): void {
    const { store } = this;
    const input = element<HTMLInputElement>('vibration');
    const show = () => (element('vibration-field').hidden = false);
    if (canVibrate()) show();
    window.addEventListener('gamepadconnected', show);
    input.addEventListener('change', () => store.set({ vibration: input.checked }));
    store.subscribe(['vibration'], ({ vibration }) => {
      input.checked = vibration;
      remember('vibration', String(vibration));
    });
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
    setText('stiffness-value', stiffness.chosen ? text.panel.chosen(value) : '');
    setText('form-value', form.chosen ? text.panel.chosen(text.panel[form.value]) : '');
    this.dial.show(form.value === 'lattice', settings.springs, stiffness.value);
  }

  private listScenes(list: SceneEntry[]): void {
    this.scene.replaceChildren(new Option(text.panel.tower, ''), ...list.map(e => new Option(titleOf(e), e.name)));
    this.scene.value = this.store.state.settings.scene ?? '';
  }

  /** Lists the stiffnesses that the device chooses from, and the one in the address. */
  private listStiffnesses(named: number | null): void {
    const all =
      named === null || STIFFNESSES.includes(named) ? STIFFNESSES : [...STIFFNESSES, named].sort((a, b) => a - b);
    this.stiffness.append(...all.map(k => new Option(newtonsPerMillimetre(k), String(k))));
  }
}

/** Lists the languages, each in itself. */
function listLanguages(): void {
  const select = element<HTMLSelectElement>('language');
  for (const [code, { language: name }] of Object.entries(LANGUAGES)) {
    const option = new Option(name, code, code === language, code === language);
    option.lang = code;
    select.add(option);
  }
  select.addEventListener('change', () => chooseLanguage(select.value));
}

/** Returns the title of a scene; that of the engine for a scene without one in this language. */
function titleOf({ name, title }: SceneEntry): string {
  const titles: Partial<Record<string, string>> = text.scenes;
  return titles[name] ?? capitalized(title);
}

function setRange(input: HTMLInputElement, { min, max }: { min: number; max: number }): void {
  input.min = String(min);
  input.max = String(max);
}
