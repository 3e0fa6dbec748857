// The dial of the stiffness of springs: a logarithmic slider from jelly to wood.

import { significant, text } from '../messages';
import { element, setText } from './dom';

/** Ends of the dial, N/m, and its steps. */
export const DIAL = { min: 1e3, max: 3e7, steps: 90 };
/** Ratio to the stiffness of the contacts within which the dial snaps to it. */
const SNAP = 1.07;

/** Returns the stiffness at a step of the dial with two significant figures, N/m. */
export function stiffnessAt(step: number): number {
  return Number((DIAL.min * (DIAL.max / DIAL.min) ** (step / DIAL.steps)).toPrecision(2));
}

/** Returns the nearest step of the dial to a stiffness, N/m. */
export function stepOf(stiffness: number): number {
  const step = Math.round((DIAL.steps * Math.log(stiffness / DIAL.min)) / Math.log(DIAL.max / DIAL.min));
  return Math.min(DIAL.steps, Math.max(0, step));
}

/**
 * Returns null, for springs as stiff as the contacts, if a stiffness of the dial is close to
 * theirs, N/m.
 */
export function snapped(stiffness: number, contacts: number): number | null {
  return Math.max(stiffness / contacts, contacts / stiffness) < SNAP ? null : stiffness;
}

export function newtonsPerMillimetre(stiffness: number): string {
  return text.readouts.stiffness(significant(stiffness / 1000, 3));
}

export class SpringsDial {
  private readonly input = element<HTMLInputElement>('springs');
  /** Chosen stiffness as it is shown, and that of the contacts, N/m. */
  private shown: { chosen: number | null; contacts: number } = { chosen: null, contacts: 1e6 };

  /** `change` takes the player's choice, N/m; null for springs as stiff as the contacts. */
  constructor(change: (chosen: number | null) => void) {
    this.input.max = String(DIAL.steps);
    this.input.addEventListener('input', () => {
      const next = snapped(stiffnessAt(Number(this.input.value)), this.shown.contacts);
      if (next !== this.shown.chosen) change(next);
    });
  }

  /** Shows the chosen stiffness of the springs and that of the contacts, N/m. */
  show(visible: boolean, chosen: number | null, contacts: number): void {
    this.shown = { chosen, contacts };
    element('springs-fields').hidden = !visible;
    const step = stepOf(chosen ?? contacts);
    // Several steps may snap to the contacts: the slider stays where the player put it.
    if (snapped(stiffnessAt(Number(this.input.value)), contacts) !== chosen) this.input.value = String(step);
    const value = newtonsPerMillimetre(chosen ?? contacts);
    const note = chosen === null ? text.panel.asContacts : '';
    setText('springs-value', value);
    setText('springs-same', note);
    this.input.setAttribute('aria-valuetext', note ? `${value}, ${note}` : value);
  }
}
