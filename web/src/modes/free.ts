// Free play: any block may be taken, and nothing is won or lost.

import { holdersOf } from '../hand/hand';
import { capitalized } from '../ui/dom';
import { heldBy } from '../ui/force-ring';
import { text } from '../messages';
import { matchOf, person } from './match';
import type { Mode, ModeUi } from './mode';

/** True once the fall of the tower has been reported; later events name further blocks. */
let reported = false;

export const free: Mode = {
  id: 'free',
  match: () => matchOf('free', 'free', [person('')]),
  rules() {
    reported = false;
    return { canTurn: true };
  },
  overlay({ tower, fallen }, blocks) {
    const { fell } = text.free;
    return { status: tower === 'fallen' ? fell(fallen.length, blocks) : text.free[tower](blocks) };
  },
  onEvent(event, ui) {
    if (event.event === 'fell' && !reported) {
      reported = true;
      ui.notice(text.free.towerFell, 6);
    }
    if (event.event === 'poked') void describeHolders(event.body, ui);
  },
};

/** Says which blocks press on a block from above. */
async function describeHolders(body: number, ui: ModeUi): Promise<void> {
  const contacts = await ui.contacts(body);
  const holders = holdersOf(contacts.filter(c => c.normal[2] < -0.5));
  ui.notice(holders.bodies.length === 0 ? text.free.loose : `${capitalized(heldBy(holders))}.`);
}
