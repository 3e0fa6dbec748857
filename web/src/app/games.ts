// Builds what games with turns need beside the tower: card, menu, records, and the end.

import { MenuDialog, type MenuEntry } from '../menu/menu-dialog';
import { games } from '../messages/games';
import { modeOf } from '../modes';
import { Autosave } from '../records/autosave';
import { Storage, type SavedGame } from '../records/storage';
import { tabName } from '../records/tab';
import { TurnHistory } from '../records/turn-history';
import { EndDialog } from '../turns/end-dialog';
import { FallScene } from '../turns/fall-scene';
import { markLegal } from '../turns/legal-marks';
import { TurnCard } from '../turns/turn-card';
import { create } from '../ui/dom';
import type { Notice } from '../ui/notice';
import type { Play } from './play';
import type { Stage } from './stage';
import type { PageStore } from './state';

/** Modes that the menu offers. */
const MENU: readonly MenuEntry[] = (
  [
    ['hot-seat', 'i-people'],
    ['solo', 'i-person'],
    ['practice', 'i-practice'],
    ['free', 'i-auto'],
  ] as const
).map(([id, symbol]) => ({ id, symbol, match: () => modeOf(id).match() }));

export class Games {
  private readonly tab = tabName();
  private readonly storage = Storage.open();
  private readonly menu: MenuDialog;
  private autosave: Autosave | null = null;

  constructor(
    store: PageStore,
    stage: Stage,
    private readonly play: Play,
    notice: Notice,
  ) {
    const height = () => stage.bodies?.top() ?? 0;
    const undoes = () => modeOf(store.state.match.mode).undo ?? false;
    const history = new TurnHistory(store, play.client, undoes);
    const undo = () => {
      const record = history.undo();
      if (record) play.resume(record, store.state.match);
    };
    const end = new EndDialog(store, {
      again: () => play.again(),
      other: () => store.set({ menuOpen: true }),
      height,
    });
    new TurnCard(store, { undo, canUndo: () => history.canUndo, height }, undoes);
    markLegal(store, stage);
    new FallScene(store, stage, () => end.show());
    this.menu = new MenuDialog(store, MENU, {
      begin: (match, rows) => play.begins(match, { rows, scene: null }),
      resign: () => play.client.command({ command: 'resign' }),
    });
    void this.storage.then(storage => (this.autosave = new Autosave(store, play.client, storage, notice, this.tab)));
  }

  /** Simulated time of the game that was saved last, s. */
  get saved(): number {
    return this.autosave?.saved ?? 0;
  }

  /** Requests the world of an unfinished game; returns false where there is none. */
  async open(): Promise<boolean> {
    const storage = await this.storage;
    const own = await storage?.game(this.tab);
    if (own && own.search === location.search) {
      this.resume(own);
      return true;
    }
    const other = await storage?.newest();
    if (other && other.turn > 1) this.offer(other);
    return false;
  }

  private resume({ record, match, settings }: SavedGame): void {
    this.play.resume(record, match, settings);
  }

  /** Offers the unfinished game of a tab that was closed. */
  private offer(game: SavedGame): void {
    const ago = games.records.ago(Math.round((Date.now() - game.at) / 60_000));
    const mode = games.modes[game.match.mode as keyof typeof games.modes]?.name ?? '';
    const words = create('small', {}, games.records.unfinished(mode, game.turn, ago));
    const button = create('button', { id: 'menu-resume', class: 'main' }, games.menu.resume, words);
    button.addEventListener('click', () => {
      this.menu.close();
      button.remove();
      this.resume(game);
    });
    this.menu.top.replaceChildren(button);
  }
}
