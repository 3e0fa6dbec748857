// Keys of the game.

import type { Hand, Mode } from './hand';
import type { Orbit } from './orbit';

export interface KeyActions {
  pause(): void;
  frame(): void;
  mode(mode: Mode): void;
  place(): void;
  help(): void;
  springs(): void;
  /** Where there is an X-ray. */
  xray?(): void;
  /** Whether keys belong to a control at the moment. */
  busy(): boolean;
}

const MODES: Record<string, Mode> = { '1': 'auto', '2': 'pull', '3': 'push', '4': 'carry' };
/** Fine turn of a held block, rad. */
const FINE = Math.PI / 90;

export function listen(hand: Hand, orbit: Orbit, actions: KeyActions): void {
  window.addEventListener('keydown', event => {
    hand.careful = event.shiftKey;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Escape') return hand.letGo();
    if (actions.busy()) return;
    // Space and Enter on a button press the button.
    if (event.target instanceof HTMLButtonElement && (event.key === ' ' || event.key === 'Enter')) return;
    if (press(event)) event.preventDefault();
  });
  window.addEventListener('keyup', event => (hand.careful = event.shiftKey));
  window.addEventListener('blur', () => (hand.careful = false));

  function press(event: KeyboardEvent): boolean {
    const carrying = hand.hold?.grip === 'carry' && !hand.frozen;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (key in MODES) actions.mode(MODES[key]);
    else if (key === ' ') {
      if (!event.repeat) actions.pause();
    } else if (key === 'f') actions.frame();
    else if (key === 'p') actions.place();
    else if (key === 's') actions.springs();
    else if (key === 'x') actions.xray?.();
    else if (key === 'h' || key === '?') actions.help();
    else if (key === 'q') hand.turn(Math.PI / 2);
    else if (key === 'e') hand.turn(-Math.PI / 2);
    else if (key === 'r') hand.tip();
    else if (key === '[' || (carrying && key === 'ArrowLeft')) hand.turn(FINE);
    else if (key === ']' || (carrying && key === 'ArrowRight')) hand.turn(-FINE);
    else if (carrying && key === 'ArrowUp') hand.depth(0.003);
    else if (carrying && key === 'ArrowDown') hand.depth(-0.003);
    else if (hand.hold && !hand.frozen) return false;
    else if (key === 'ArrowLeft') orbit.turn(-0.12, 0);
    else if (key === 'ArrowRight') orbit.turn(0.12, 0);
    else if (key === 'ArrowUp') orbit.turn(0, 0.1);
    else if (key === 'ArrowDown') orbit.turn(0, -0.1);
    else if (key === '+' || key === '=') orbit.zoom(0.88);
    else if (key === '-') orbit.zoom(1 / 0.88);
    else return false;
    return true;
  }
}
