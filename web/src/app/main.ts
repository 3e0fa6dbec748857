// The page of the game: builds its parts and ties them together.

import { text } from '../messages';
import { fillDocument } from '../messages/fill';
import { modeOf } from '../modes';
import { element } from '../ui/dom';
import { Gallery } from '../ui/gallery';
import { HelpDialog } from '../ui/help-dialog';
import { Notice, showTrouble } from '../ui/notice';
import { Readouts } from '../ui/readouts';
import { SettingsPanel } from '../ui/settings-panel';
import { SoundControls } from '../ui/sound-controls';
import { SpringsLegend } from '../ui/springs-legend';
import { Toolbar } from '../ui/toolbar';
import { offerVersions } from '../ui/version-offer';
import { Labels } from '../xray/labels';
import { XRayOverlay } from '../xray/overlay';
import { Pointers } from '../hand/pointers';
import { connectDevices } from './devices';
import { Games } from './games';
import { createInspect } from './inspect';
import { Play } from './play';
import { followColourScheme, Stage } from './stage';
import { initialPage, type PageStore } from './state';
import { Store } from './store';
import { missingFeature } from './support';
import { readOptions, type Options } from './url';

function start(): void {
  fillDocument();
  const missing = missingFeature();
  if (missing) return showTrouble(missing);
  const options = readOptions(location.search);
  const store = new Store(initialPage(options, modeOf(options.mode).match()));
  const stage = createStage(options, store);
  if (!stage) return showTrouble(text.trouble.noWebGl);
  followColourScheme(store);

  const notice = new Notice();
  const play = new Play(store, stage, notice, xray => stage.bodies && overlay.receive(xray, stage.bodies));
  const { hand } = play;
  const labels = new Labels(element('labels'));
  const overlay = new XRayOverlay(store, hand, stage.view, labels);
  const frame = () => stage.frame();
  const pointers = new Pointers(stage.canvas, store, hand, stage.orbit, { bodies: () => stage.bodies, frame });

  const games = new Games(store, stage, play, notice, options.help);
  new HelpDialog(store);
  new SettingsPanel(store, play, options);
  new SoundControls(store);
  new Gallery(play);
  const toolbar = new Toolbar(store, play);
  const readouts = new Readouts(store, stage);
  const toggleSprings = () => store.set({ overlay: store.state.overlay === 'springs' ? 'none' : 'springs' });
  const springs = new SpringsLegend(toggleSprings, () => play.setForm('lattice'));
  const pads = connectDevices(store, stage, play, () => games.hint());
  const showLegends = () => {
    springs.show(store.state.overlay === 'springs', store.state.form.value === 'lattice' ? stage.forces.end : null);
    overlay.showLegend();
  };
  store.subscribe(['overlay'], showLegends);

  play.start(() => games.open());
  offerVersions(store, notice);
  stage.run(hand, {
    springs: () => store.state.overlay === 'springs',
    holders: () => hand.holders()?.bodies ?? [],
    update(elapsed) {
      toolbar.showCarrying(hand.carries);
      pads.poll(elapsed);
    },
    readout() {
      readouts.show();
      showLegends();
      toolbar.showPlaceable(hand.canPlace());
    },
    follow: (moved, now) => labels.follow(stage.bodies!, stage.orbit, moved, now),
  });
  const { client, sound } = play;
  window.teeter = createInspect({ store, stage, hand, pointers, labels, client, sound, games });
}

/** Returns null where the browser has no WebGL 2. */
function createStage(options: Options, store: PageStore): Stage | null {
  try {
    return new Stage(options, store);
  } catch {
    return null;
  }
}

start();
