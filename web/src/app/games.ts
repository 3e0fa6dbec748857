// Builds what games need beside the tower: card, menu, records, and the end. It decides which game
// the page opens with.

import { Guide } from '../guide/guide';
import { MenuDialog, type MenuEntry } from '../menu/menu-dialog';
import { games } from '../messages';
import { modeOf } from '../modes';
import { dailySettings, dailySetup, dayOf } from '../modes/daily';
import { matchOf, person, type Match } from '../modes/match';
import { Autosave } from '../records/autosave';
import { DailyGames } from '../records/daily-games';
import { chooseFile, listenToDrops } from '../records/files';
import { recordIn } from '../records/link';
import { Opener } from '../records/opener';
import { Sharing } from '../records/sharing';
import { Storage, type SavedGame } from '../records/storage';
import { tabName } from '../records/tab';
import { TurnHistory } from '../records/turn-history';
import { ReplayBar } from '../replay/replay-bar';
import type { Verified } from '../study/jobs';
import { showAftermath } from '../turns/aftermath';
import { EndDialog } from '../turns/end-dialog';
import { FallScene } from '../turns/fall-scene';
import { Hints } from '../turns/hints';
import { markLegal } from '../turns/legal-marks';
import { TurnCard } from '../turns/turn-card';
import { create } from '../ui/dom';
import type { Notice } from '../ui/notice';
import { recall, remember } from './memory';
import type { Play } from './play';
import type { Stage } from './stage';
import type { PageStore, Settings } from './state';

/** Modes that the menu offers. */
const MENU: readonly MenuEntry[] = (
  [
    ['hot-seat', 'i-people'],
    ['opponent', 'i-robot'],
    ['daily', 'i-day'],
    ['solo', 'i-person'],
    ['practice', 'i-practice'],
    ['free', 'i-auto'],
  ] as const
).map(([id, symbol]) => ({ id, symbol, match: () => modeOf(id).match() }));

/** A record that is played again. */
interface Opened {
  bytes: Uint8Array;
  verified: Verified;
}

export class Games {
  private readonly tab = tabName();
  private readonly storage = Storage.open();
  private readonly menu: MenuDialog;
  private readonly opener: Opener;
  private readonly sharing: Sharing;
  private readonly hints: Hints;
  private readonly daily: DailyGames;
  /** Settings of towers that the player chose, which those of a day leave as they are. */
  private readonly own: Settings;
  private autosave: Autosave | null = null;
  private opened: Opened | null = null;

  /** `guides`: true if the first visit is guided. */
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly play: Play,
    notice: Notice,
    private readonly guides: boolean,
  ) {
    this.own = store.state.settings;
    this.opener = new Opener(play, notice);
    this.sharing = new Sharing(store, play, notice);
    this.hints = new Hints(store, play, notice);
    this.daily = new DailyGames({ store, stage, play }, this.storage, notice, record => void this.openRecord(record));
    this.menu = this.createMenu();
    this.createTurns();
    new ReplayBar(store, play, {
      challenge: () => this.challenge(),
      save: () => void this.sharing.save(this.opened?.bytes ?? null),
      close: () => void this.leaveReplay(),
    });
    listenToDrops((bytes, name) => void this.openRecord(bytes, name));
    window.addEventListener('hashchange', () => void this.openLink());
    const { records, menu } = games;
    const save = () => void this.sharing.save(null);
    const lost = () => notice.offer({ text: records.notKept, label: records.save, close: menu.close, action: save });
    void this.storage.then(storage => (this.autosave = new Autosave(store, play.client, storage, this.tab, lost)));
  }

  /** Simulated time of the game that was saved last, s. */
  get saved(): number {
    return this.autosave?.saved ?? 0;
  }

  /** Poses of the ghost of the best game on the tower of the day; null where none is shown. */
  get ghost(): Float32Array | null {
    return this.daily.ghost;
  }

  /** Shows the safest block. */
  hint(): void {
    void this.hints.show();
  }

  /** Requests the world that the page opens with; returns false for that of the settings. */
  async open(): Promise<boolean> {
    if (await this.openLink()) return true;
    const own = await this.ownGame();
    if (own && own.search === location.search) {
      this.resume(own);
      return true;
    }
    const other = await (await this.storage)?.newest().catch(() => null);
    if (other && other.turn > 1) this.offer(other);
    const { mode } = this.store.state.match;
    if (mode === 'free') this.guide();
    if (mode !== 'daily') return false;
    this.begin(this.store.state.match, 0);
    return true;
  }

  private createMenu(): MenuDialog {
    const { store, play, sharing } = this;
    return new MenuDialog(store, MENU, {
      begin: (match, rows) => this.begin(match, rows),
      openFile: () => chooseFile((bytes, name) => void this.openRecord(bytes, name)),
      save: () => void sharing.save(null),
      share: () => void sharing.shareMove(),
      resign: () => play.client.command({ command: 'resign' }),
      more: (mode, room) => {
        if (mode === 'daily') void this.daily.fill(room, () => this.menu.close());
      },
    });
  }

  private createTurns(): void {
    const { store, stage, play, sharing } = this;
    const height = () => stage.bodies?.top() ?? 0;
    const undoes = () => modeOf(store.state.match.mode).undo ?? false;
    const history = new TurnHistory(store, play.client, undoes);
    const undo = () => {
      const record = history.undo();
      if (record) play.resume(record, store.state.match);
    };
    const end = new EndDialog(store, {
      again: () => this.again(),
      other: () => store.set({ menuOpen: true }),
      watch: () => void this.watchAgain(),
      share: () => void sharing.shareMove(),
      save: () => void sharing.save(null),
      height,
    });
    const card = { undo, canUndo: () => history.canUndo, height, hint: () => this.hint() };
    new TurnCard(store, card, undoes);
    markLegal(store, stage);
    new FallScene(store, stage, () => {
      if (store.state.world?.frames != null) return;
      const turns = store.state.frame?.update.turn?.number ?? 1;
      end.show((room, match) => {
        const [ranking, plot] = [create('div'), create('div')];
        room.append(ranking, plot);
        void showAftermath(play, plot, match, turns);
        if (match.mode === 'daily') void this.daily.finish().then(() => this.daily.fill(ranking, () => end.close()));
      });
    });
  }

  /** Guides the first visit. */
  private guide(): void {
    if (!this.guides || recall('help') !== null) return;
    new Guide(this.store, this.stage, this.play, {
      offer: mode => this.menu.offer(mode),
      closed: () => remember('help', 'seen'),
    });
  }

  private begin(match: Match, rows: number): void {
    const day = dailySettings(dayOf(new Date()));
    const { block, form, stiffness, springs } = this.own;
    this.clearLink();
    if (match.mode === 'daily') this.play.begins(match, day);
    else if (this.store.state.match.mode === 'daily')
      this.play.begins(match, { rows, scene: null, seed: this.own.seed, block, form, stiffness, springs });
    else this.play.begins(match, { rows, scene: null });
  }

  private again(): void {
    const { mode } = this.store.state.match;
    if (mode === 'challenge') this.challenge();
    else if (mode === 'daily') this.play.build();
    else this.play.again();
  }

  /** Begins a game on the tower at the start of the record that is shown. */
  private challenge(): void {
    if (!this.opened) return;
    const { scene, rules, pull, turn } = this.opened.verified;
    const table = rules.table === 'free' || turn === null ? 'friendly' : rules.table;
    const goal = pull ?? undefined;
    this.clearLink();
    this.play.beginsOn(scene, { ...matchOf('challenge', table, [person('')]), goal });
  }

  private async watchAgain(): Promise<void> {
    const record = await this.play.client.ask({ what: 'record', state: false });
    if (record) await this.openRecord(record.bytes);
  }

  /**
   * Plays a record on the page where it is true. One on the tower of the day that comes from a file
   * of a name is offered to be ranked first. Returns true where it is played.
   */
  private async openRecord(bytes: Uint8Array, file: string | null = null): Promise<boolean> {
    const verified = await this.opener.verify(bytes, dailySetup(dayOf(new Date())));
    if (!verified) return false;
    if (file !== null && verified.begins && !(await this.daily.offer(bytes, verified, file))) return false;
    await this.autosave?.save();
    this.opened = { bytes, verified };
    this.opener.show(bytes, verified);
    return true;
  }

  /** Goes on with the game that the record interrupted, else with free play. */
  private async leaveReplay(): Promise<void> {
    const game = await this.ownGame();
    if (!game) return this.begin(modeOf('free').match(), this.store.state.settings.rows);
    this.clearLink();
    this.resume(game);
  }

  private async openLink(): Promise<boolean> {
    const record = recordIn(location.hash);
    return record !== null && (await this.openRecord(record, ''));
  }

  /** Another game is not that of the link any more. */
  private clearLink(): void {
    if (recordIn(location.hash)) history.replaceState(null, '', location.pathname + location.search);
  }

  /** Unfinished game of this tab. */
  private async ownGame(): Promise<SavedGame | undefined> {
    return (await this.storage)?.game(this.tab).catch(() => undefined);
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
