// The first minute: one turn that is shown by a moving hand with a line of text, and then an offer
// to play. It follows what the player does, and goes away at once when it is closed.

import type { Play } from '../app/play';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import { games } from '../messages';
import { create, element, icon } from '../ui/dom';
import { endOf, looseBlock } from './loose-block';

/** Step of the guide: the tower comes to rest, a block is pulled, it is carried, a turn is done. */
type Step = 'waiting' | 'pulling' | 'carrying' | 'done';

export interface GuideActions {
  /** Opens the menu at a mode. */
  offer(mode: string): void;
  /** Called once the guide is closed. */
  closed(): void;
}

export class Guide {
  private readonly bubble = create('div', { id: 'coach', role: 'status' });
  private readonly pointer = create('div', { id: 'coach-hand', 'aria-hidden': 'true', hidden: true }, icon('i-auto'));
  private step: Step = 'waiting';
  private body: number | null = null;
  private open = true;
  private asked = false;

  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly play: Play,
    private readonly actions: GuideActions,
  ) {
    element('stage').after(this.bubble, this.pointer);
    this.bubble.hidden = true;
    store.subscribe(['frame'], () => this.open && this.follow());
  }

  /** Ends the guide. */
  close(): void {
    if (!this.open) return;
    this.open = false;
    this.bubble.remove();
    this.pointer.remove();
    if (this.store.state.selected === this.body) this.store.set({ selected: null });
    this.actions.closed();
  }

  private follow(): void {
    const { frame, menuOpen, helpOpen } = this.store.state;
    if (!frame) return;
    const { update } = frame;
    if (menuOpen || helpOpen || update.turn || frame.replay) return this.close();
    const events = update.events.map(({ event }) => event);
    if (events.includes('placed') || events.includes('fell')) this.finish(events.includes('placed'));
    else if (update.hand?.grip === 'carry') this.enter('carrying', games.guide.carry);
    else if (this.step === 'waiting' && update.at_rest) void this.choose();
    else if (this.step === 'carrying' && !update.hand) this.enter('carrying', games.guide.press);
    this.point();
  }

  private async choose(): Promise<void> {
    if (this.asked) return;
    this.asked = true;
    const forces = await this.play.client.ask({ what: 'xray' });
    const block = forces && looseBlock(this.stage, forces);
    if (!block || !this.open || this.step !== 'waiting') return;
    this.body = block.body;
    this.store.set({ selected: block.body });
    this.enter('pulling', games.guide.pull);
  }

  private enter(step: Step, line: string): void {
    if (this.step === step && this.bubble.firstElementChild?.textContent === line) return;
    this.step = step;
    const close = create('button', { id: 'coach-close', class: 'plain', 'aria-label': games.menu.close });
    close.append(icon('i-close'));
    close.addEventListener('click', () => this.close());
    this.bubble.replaceChildren(create('p', {}, line), close);
    this.bubble.hidden = false;
  }

  /** Moves the hand along the block that is to be pulled. */
  private point(): void {
    const shown = this.step === 'pulling' && this.body !== null && !this.store.state.frame!.update.hand;
    const end = shown ? endOf(this.stage, this.body!) : null;
    this.pointer.hidden = end === null;
    if (!end) return;
    const { style } = this.pointer;
    style.left = `${end.at.x.toFixed(0)}px`;
    style.top = `${end.at.y.toFixed(0)}px`;
    style.setProperty('--dx', `${(end.out.x - end.at.x).toFixed(0)}px`);
    style.setProperty('--dy', `${(end.out.y - end.at.y).toFixed(0)}px`);
  }

  private finish(placed: boolean): void {
    this.enter('done', placed ? games.guide.done : games.guide.fell);
    const button = (id: string, label: string, action: () => void, main = false) => {
      const node = create('button', { id, class: main ? 'main' : 'plain' }, label);
      node.addEventListener('click', () => {
        this.close();
        action();
      });
      return node;
    };
    const { offer } = this.actions;
    const { modes, guide } = games;
    this.bubble.append(
      create(
        'div',
        { class: 'buttons' },
        button('coach-together', modes['hot-seat'].name, () => offer('hot-seat'), true),
        button('coach-computer', modes.opponent.name, () => offer('opponent'), true),
        button('coach-free', guide.on, () => undefined),
      ),
    );
  }
}
