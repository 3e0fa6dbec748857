// Free play: any block may be taken, and nothing is won or lost.

import type { Update } from '../engine/game-protocol';
import { holdersOf } from '../hand/hand';
import { capitalized } from '../ui/dom';
import { heldBy } from '../ui/force-ring';
import type { Mode, ModeUi } from './mode';

const STATES: Record<Update['tower'], string> = { standing: 'Standing', moving: 'Moving', fallen: 'Fallen' };

/** True once the fall of the tower has been reported; later events name further blocks. */
let reported = false;

export const free: Mode = {
  id: 'free',
  rules() {
    reported = false;
    return { canTurn: true };
  },
  overlay({ tower, fallen }, blocks) {
    const fell = `${fallen.length} of ${blocks} blocks fell`;
    return { status: tower === 'fallen' ? fell : `${STATES[tower]} · ${blocks} blocks` };
  },
  onEvent(event, ui) {
    if (event.event === 'fell' && !reported) {
      reported = true;
      ui.notice('The tower fell.', 6);
    }
    if (event.event === 'poked') void describeHolders(event.body, ui);
  },
};

/** Says which blocks press on a block from above. */
async function describeHolders(body: number, ui: ModeUi): Promise<void> {
  const contacts = await ui.contacts(body);
  const holders = holdersOf(contacts.filter(c => c.normal[2] < -0.5));
  ui.notice(holders.bodies.length === 0 ? 'Loose: nothing presses on it.' : `${capitalized(heldBy(holders))}.`);
}
