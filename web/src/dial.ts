// The dial of the stiffness of springs: a slider that goes by factors, from jelly to wood.

/** Ends of the dial, N/m. */
export const DIAL = { least: 1e3, most: 3e7, steps: 90 };
/** Ratio to the stiffness of the contacts within which the dial means to be at it. */
const SNAP = 1.07;

/** The stiffness at a step of the dial, N/m, in two figures. */
export function stiffnessAt(step: number): number {
  return Number((DIAL.least * (DIAL.most / DIAL.least) ** (step / DIAL.steps)).toPrecision(2));
}

/** The step of the dial that is nearest to a stiffness, N/m. */
export function stepOf(stiffness: number): number {
  const step = Math.round((DIAL.steps * Math.log(stiffness / DIAL.least)) / Math.log(DIAL.most / DIAL.least));
  return Math.min(DIAL.steps, Math.max(0, step));
}

/** What is meant by a stiffness of the dial: null, as stiff as the contacts, where it is near to theirs. */
export function meant(stiffness: number, contacts: number): number | null {
  return Math.max(stiffness / contacts, contacts / stiffness) < SNAP ? null : stiffness;
}

export function newtonsPerMillimetre(stiffness: number): string {
  return `${Number((stiffness / 1000).toPrecision(3))} N/mm`;
}

export class SpringsDial {
  private readonly input = document.getElementById('springs') as HTMLInputElement;
  private readonly output = document.getElementById('springs-value')!;
  private readonly same = document.getElementById('springs-same')!;
  private readonly fields = document.getElementById('springs-fields')!;
  /** Stiffness of the contacts, N/m. */
  contacts = 1e6;

  /** `chosen`: what the player has chosen, N/m; null for springs as stiff as the contacts. `change` is told of every other choice. */
  constructor(
    public chosen: number | null,
    change: (chosen: number | null) => void,
  ) {
    this.input.max = String(DIAL.steps);
    this.input.addEventListener('input', () => {
      const next = meant(stiffnessAt(Number(this.input.value)), this.contacts);
      if (next === this.chosen) return;
      this.chosen = next;
      this.label();
      change(next);
    });
  }

  /** Tells the stiffness of the springs in the tower, N/m; null where it has none, and the dial is hidden. */
  tell(springs: number | null): void {
    this.fields.hidden = springs === null;
    if (springs === null) return;
    this.input.value = String(stepOf(this.chosen ?? this.contacts));
    this.label();
  }

  private label(): void {
    const value = newtonsPerMillimetre(this.chosen ?? this.contacts);
    this.output.textContent = value;
    this.same.textContent = this.chosen === null ? 'as the contacts' : '';
    this.input.setAttribute('aria-valuetext', this.chosen === null ? `${value}, as the contacts` : value);
  }
}
