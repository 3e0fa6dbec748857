// The constants of the 2003 method: switches for the choices that its text discusses, and a list of
// all others, each with its unit, its range and its meaning. They act on the standing tower.

import { text } from '../messages';
import { capitalized, element } from '../ui/dom';
import type { ConstantEntry, ConstantValues } from './protocol';
import type { MuseumStore } from './state';

/** Names of the switches, in order. */
const SWITCHES: Record<string, string> = text.museum.constants.switches;
/** Names of values, where those of the ini file do not say enough. */
const VALUES: Record<string, string> = text.museum.constants.values;
/** Coefficient of static friction when it is switched on, that of kinetic friction. */
const STATIC_FRICTION = '0.4';

/** Sets constants; returns null, or why they are not accepted. */
export type SetConstants = (values: ConstantValues) => Promise<string | null>;

export class ConstantsPanel {
  private readonly problem = element('constants-problem');
  private table: ConstantEntry[] = [];
  private readonly controls = new Map<string, HTMLInputElement | HTMLSelectElement>();

  constructor(
    private readonly store: MuseumStore,
    private readonly apply: SetConstants,
  ) {
    element('constants-default').addEventListener('click', () => {
      void this.set(Object.fromEntries(this.table.map(entry => [entry.name, defaultOf(entry)])));
    });
    store.subscribe(['setup'], () => this.show());
  }

  /** Builds the controls. */
  begin(table: ConstantEntry[]): void {
    this.table = table;
    const find = (name: string) => table.find(entry => entry.name === name)!;
    const switches = Object.entries(SWITCHES).map(([name, label]) => this.row(find(name), label));
    element('choices-2003').replaceChildren(...switches);
    element('method-of-hand').replaceChildren(this.row(find('hand'), text.museum.constants.hand));
    const rest = table.filter(({ name }) => !(name in SWITCHES) && name !== 'hand');
    const list = element('constants-list');
    list.replaceChildren();
    for (const section of new Set(rest.map(entry => entry.section))) {
      const heading = document.createElement('h3');
      heading.textContent = section;
      const group = document.createElement('div');
      group.append(heading, ...rest.filter(e => e.section === section).map(e => this.row(e, nameOf(e))));
      list.append(group);
    }
    this.show();
  }

  /** Returns a labelled control of a constant. */
  private row(entry: ConstantEntry, label: string): HTMLLabelElement {
    const row = document.createElement('label');
    row.className = 'constant';
    row.title = text.museum.constants.hint(capitalized(entry.meaning), defaultOf(entry), entry.reason);
    const name = document.createElement('span');
    name.textContent = label;
    const control = this.control(entry);
    control.dataset.constant = entry.name;
    this.controls.set(entry.name, control);
    row.append(name, control);
    return row;
  }

  private control(entry: ConstantEntry): HTMLInputElement | HTMLSelectElement {
    const { name, range } = entry;
    if (range.kind === 'choice') {
      const select = document.createElement('select');
      select.append(...range.names.map(value => new Option(VALUES[value] ?? value, value)));
      select.addEventListener('change', () => void this.set({ [name]: select.value }));
      return select;
    }
    const input = document.createElement('input');
    if (isSwitch(entry)) {
      input.type = 'checkbox';
      const values = range.kind === 'switch' ? ['false', 'true'] : ['none', STATIC_FRICTION];
      input.addEventListener('change', () => void this.set({ [name]: values[Number(input.checked)] }));
    } else {
      input.inputMode = 'decimal';
      input.spellcheck = false;
      input.autocomplete = 'off';
      input.addEventListener('change', () => void this.set({ [name]: input.value.trim() }));
    }
    return input;
  }

  private async set(values: ConstantValues): Promise<void> {
    const refused = await this.apply(values);
    this.problem.textContent = refused ? `${capitalized(refused)}.` : '';
    // What was refused is shown no longer: the controls are those of the tower.
    this.show();
  }

  /** Shows the constants of the tower. */
  private show(): void {
    const { constants } = this.store.state.setup;
    for (const entry of this.table) {
      const value = constants[entry.name] ?? defaultOf(entry);
      const control = this.controls.get(entry.name)!;
      if (control instanceof HTMLInputElement && control.type === 'checkbox')
        control.checked = value !== 'false' && value !== 'none';
      else control.value = value;
      control.parentElement!.classList.toggle('changed', value !== defaultOf(entry));
    }
  }
}

/** Returns the default as text. */
export function defaultOf(entry: ConstantEntry): string {
  return entry.default === null ? 'none' : String(entry.default);
}

function isSwitch({ range, name }: ConstantEntry): boolean {
  return range.kind === 'switch' || name === 'static_friction';
}

/** Returns the name in words, with the unit. */
function nameOf({ name, unit }: ConstantEntry): string {
  const words = capitalized(name.replaceAll('_', ' '));
  return unit ? `${words}, ${unit}` : words;
}
