// Controls and readouts. It knows no physics: it calls what main gives it, and shows what main tells it.

import type { Mode } from './hand';
import { STIFFNESSES } from './device';
import { newtonsPerMillimetre, SpringsDial } from './dial';
import type { BlockPreset, Constant, Form, SceneEntry, SceneSource, Setup } from './protocol';
import { CAP, MOST_SEED, ROWS, type Options } from './query';
import type { State } from './verdict';

export interface Actions {
  build(setup: Setup): void;
  reset(): void;
  pause(paused: boolean): void;
  mode(mode: Mode): void;
  cap(force: number): void;
  place(): void;
  turn(quarters: number): void;
  tip(): void;
  letGo(): void;
  /** Makes the blocks of the running tower what they are to be; `springs` as in [`Setup`]. */
  form(form: Form, springs: number | null): void;
  /** Shows the springs, or wood. */
  springs(shown: boolean): void;
}

export interface Readouts {
  state: State | 'paused';
  fallen: number;
  blocks: number;
  awake: number;
  time: number;
  fps: number;
  factor: number;
  capacity: number;
  /** Deepest overlap, m. */
  overlap: number;
  quality: string;
}

/** Scenes of the list that the tower's own controls cover. */
const COVERED = ['tower', 'official'];
/** Below this the page says that it is slow. */
export const SLOW = 0.95;
const SEEN_HELP = 'teeter.help';

const get = <T extends HTMLElement = HTMLElement>(id: string) => document.getElementById(id) as T;

export class Panel {
  private readonly scene = get<HTMLSelectElement>('scene');
  private readonly rows = get<HTMLInputElement>('rows');
  private readonly block = get<HTMLSelectElement>('block');
  private readonly seed = get<HTMLInputElement>('seed');
  private readonly cap = get<HTMLInputElement>('cap');
  private readonly stiffness = get<HTMLSelectElement>('stiffness');
  private readonly form = get<HTMLSelectElement>('form');
  private readonly dial: SpringsDial;
  private readonly showSprings = get<HTMLInputElement>('show-springs');
  private readonly sleep = get<HTMLInputElement>('sleep');
  private readonly pause = get<HTMLButtonElement>('pause');
  private readonly help = get<HTMLDialogElement>('help');
  private readonly panel = get('panel');
  private readonly settings = get<HTMLButtonElement>('settings');
  private readonly modes = [...document.querySelectorAll<HTMLButtonElement>('[data-mode]')];

  constructor(
    options: Options,
    private readonly actions: Actions,
  ) {
    this.rows.value = String(options.rows);
    this.block.value = options.block;
    this.seed.value = String(options.seed);
    this.sleep.checked = options.sleep;
    this.setStiffnesses(options.stiffness);
    this.form.value = options.form ?? '';
    this.dial = new SpringsDial(options.springs, springs => actions.form('lattice', springs));
    this.cap.min = String(CAP.least);
    this.cap.max = String(CAP.most);
    this.cap.value = String(options.cap);
    this.setScenes([], options.scene);
    this.showValues();
    this.wire();
    if (options.help && !seenHelp()) this.openHelp();
  }

  /** The list of scenes; `chosen` is kept if it is in there. */
  setScenes(list: SceneEntry[], chosen: string | null): void {
    const entries = list.filter(entry => !COVERED.includes(entry.name));
    this.scene.replaceChildren(new Option('Tower', ''), ...entries.map(e => new Option(capital(e.title), e.name)));
    this.scene.value = entries.some(e => e.name === chosen) ? chosen! : '';
    this.showValues();
  }

  setup(): Setup {
    return {
      source: this.source(),
      sleep: this.sleep.checked,
      stiffness: Number(this.stiffness.value) || null,
      form: this.chosenForm(),
      springs: this.dial.chosen,
    };
  }

  private source(): SceneSource {
    if (this.scene.value) return { kind: 'named', name: this.scene.value };
    return {
      kind: 'tower',
      rows: Number(this.rows.value),
      seed: this.seedValue(),
      block: this.block.value as BlockPreset,
    };
  }

  private chosenForm(): Form | null {
    return (this.form.value || null) as Form | null;
  }

  /** The player wants blocks of a form, in the tower that stands too. */
  chooseForm(form: Form): void {
    this.form.value = form;
    this.actions.form(form, this.dial.chosen);
  }

  /** Tells what the blocks are, and how stiff the springs within them (N/m; null where they are rigid). */
  setForm({ value, chosen }: Constant<Form>, springs: number | null): void {
    const words = { rigid: 'Rigid', lattice: 'Springs inside' };
    put('form-value', chosen ? `${words[value]}, chosen for this device.` : '');
    this.dial.tell(springs);
  }

  setWatching(watching: boolean): void {
    this.showSprings.checked = watching;
  }

  /** Tells the stiffness that was chosen for the tower; one that the player chose stands in the list. */
  setStiffness({ value, chosen }: Constant<number>): void {
    this.dial.contacts = value;
    put('stiffness-value', chosen ? `${newtonsPerMillimetre(value)}, chosen for this device.` : '');
  }

  setMode(mode: Mode): void {
    for (const button of this.modes) {
      const chosen = button.dataset.mode === mode;
      button.setAttribute('aria-checked', String(chosen));
      button.tabIndex = chosen ? 0 : -1;
    }
  }

  setPaused(paused: boolean): void {
    this.pause.setAttribute('aria-pressed', String(paused));
    this.pause.querySelector('use')!.setAttribute('href', paused ? '#i-play' : '#i-pause');
    this.pause.querySelector('span')!.textContent = paused ? 'Go on' : 'Pause';
  }

  setCarrying(carrying: boolean): void {
    get('carrying').hidden = !carrying;
  }

  setPlaceable(placeable: boolean): void {
    get<HTMLButtonElement>('place').disabled = !placeable;
  }

  show(r: Readouts): void {
    const words = { standing: 'Standing', moving: 'Moving', fallen: 'Fallen', paused: 'Paused' };
    put(
      'state',
      r.state === 'fallen' ? `${r.fallen} of ${r.blocks} blocks fell` : `${words[r.state]} · ${r.blocks} blocks`,
    );
    put('fps', `${r.fps.toFixed(0)} fps`);
    const slow = r.state !== 'paused' && r.factor < SLOW;
    put('factor', slow ? `slow motion ${r.factor.toFixed(2)}×` : `real time ${r.factor.toFixed(2)}×`);
    get('factor').classList.toggle('slow', slow);
    if (this.panel.hidden) return;
    put('n-blocks', String(r.blocks));
    put('n-awake', String(r.awake));
    put('n-time', `${r.time.toFixed(1)} s`);
    put('n-capacity', `${r.capacity.toFixed(1)}×`);
    put('n-overlap', `${(r.overlap * 1000).toFixed(3)} mm`);
    put('n-quality', r.quality);
  }

  openHelp(): void {
    if (!this.help.open) this.help.showModal();
  }

  /** Whether keys belong to a control and not to the game. */
  busy(): boolean {
    const at = document.activeElement;
    return this.help.open || at instanceof HTMLInputElement || at instanceof HTMLSelectElement;
  }

  private wire(): void {
    const { actions } = this;
    const rebuild = () => actions.build(this.setup());
    for (const input of [this.rows, this.cap]) input.addEventListener('input', () => this.showValues());
    this.rows.addEventListener('change', rebuild);
    this.block.addEventListener('change', rebuild);
    this.stiffness.addEventListener('change', rebuild);
    this.sleep.addEventListener('change', rebuild);
    this.form.addEventListener('change', () => {
      const form = this.chosenForm();
      if (form) actions.form(form, this.dial.chosen);
      else rebuild();
    });
    this.showSprings.addEventListener('change', () => actions.springs(this.showSprings.checked));
    this.scene.addEventListener('change', () => {
      this.showValues();
      rebuild();
    });
    this.seed.addEventListener('change', () => {
      this.seed.value = String(this.seedValue());
      rebuild();
    });
    get('new-seed').addEventListener('click', () => {
      this.seed.value = String(1 + Math.floor(Math.random() * 99_999));
      rebuild();
    });
    this.cap.addEventListener('input', () => actions.cap(Number(this.cap.value)));
    this.pause.addEventListener('click', () => actions.pause(this.pause.getAttribute('aria-pressed') !== 'true'));
    get('reset').addEventListener('click', () => actions.reset());
    get('place').addEventListener('click', () => actions.place());
    get('turn-left').addEventListener('click', () => actions.turn(1));
    get('turn-right').addEventListener('click', () => actions.turn(-1));
    get('tip').addEventListener('click', () => actions.tip());
    get('let-go').addEventListener('click', () => actions.letGo());
    this.settings.addEventListener('click', () => this.togglePanel(this.panel.hidden !== false));
    get('panel-close').addEventListener('click', () => this.togglePanel(false));
    get('help-open').addEventListener('click', () => this.openHelp());
    this.help.addEventListener('close', () => rememberHelp());
    this.modes.forEach((button, i) => {
      button.addEventListener('click', () => actions.mode(button.dataset.mode as Mode));
      button.addEventListener('keydown', event => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!step) return;
        const next = this.modes[(i + step + this.modes.length) % this.modes.length];
        next.focus();
        next.click();
        event.preventDefault();
        event.stopPropagation();
      });
    });
  }

  /** Those that the device chooses from, and the one that the address names. */
  private setStiffnesses(named: number | null): void {
    const all =
      named === null || STIFFNESSES.includes(named) ? STIFFNESSES : [...STIFFNESSES, named].sort((a, b) => a - b);
    this.stiffness.append(...all.map(k => new Option(newtonsPerMillimetre(k), String(k))));
    this.stiffness.value = named === null ? '' : String(named);
  }

  private togglePanel(open: boolean): void {
    this.panel.hidden = !open;
    this.settings.setAttribute('aria-expanded', String(open));
    if (!open) this.settings.focus({ preventScroll: true });
  }

  private seedValue(): number {
    const value = Math.round(Number(this.seed.value));
    return Number.isFinite(value) ? Math.min(MOST_SEED, Math.max(0, value)) : 1;
  }

  private showValues(): void {
    this.rows.min = String(ROWS.least);
    this.rows.max = String(ROWS.most);
    put('rows-value', this.rows.value);
    put('cap-value', `${Number(this.cap.value).toFixed(1)} N`);
    get('tower-fields').hidden = this.scene.value !== '';
  }
}

function put(id: string, text: string): void {
  const element = get(id);
  if (element.textContent !== text) element.textContent = text;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

// Storage may be forbidden; the sheet then opens on every visit.
function seenHelp(): boolean {
  try {
    return localStorage.getItem(SEEN_HELP) !== null;
  } catch {
    return false;
  }
}

function rememberHelp(): void {
  try {
    localStorage.setItem(SEEN_HELP, 'seen');
  } catch {
    // Nothing depends on it.
  }
}
