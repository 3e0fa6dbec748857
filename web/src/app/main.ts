// The page of the game: builds its parts and ties them together.

import { text } from '../messages';
import { fillDocument } from '../messages/fill';
import { modeOf } from '../modes';
import { HelpDialog } from '../ui/help-dialog';
import { Notice, showTrouble } from '../ui/notice';
import { Readouts } from '../ui/readouts';
import { SettingsPanel } from '../ui/settings-panel';
import { SpringsLegend } from '../ui/springs-legend';
import { Toolbar } from '../ui/toolbar';
import { Labels } from '../xray/labels';
import { XRayOverlay } from '../xray/overlay';
import { Pointers } from '../hand/pointers';
import { createInspect } from './inspect';
import { Play } from './play';
import { listenToKeys } from './shortcuts';
import { followColourScheme, Stage } from './stage';
import { initialPage } from './state';
import { Store } from './store';
import { missingFeature } from './support';
import { readOptions } from './url';

function start(): void {
  fillDocument();
  const missing = missingFeature();
  if (missing) return showTrouble(missing);
  const options = readOptions(location.search);
  const store = new Store(initialPage(options));
  const stage = createStage();
  if (!stage) return showTrouble(text.trouble.noWebGl);
  followColourScheme(store);

  const mode = modeOf(options.mode);
  const play = new Play(store, stage, mode, new Notice(), xray => stage.bodies && overlay.receive(xray, stage.bodies));
  const { hand } = play;
  const labels = new Labels();
  const overlay = new XRayOverlay(store, hand, stage.view, labels);
  const frame = () => stage.frame();
  const pointers = new Pointers(stage.canvas, store, hand, stage.orbit, { bodies: () => stage.bodies, frame });

  const help = new HelpDialog(store, options);
  new SettingsPanel(store, play, options);
  const toolbar = new Toolbar(store, play);
  const readouts = new Readouts(store, stage, mode);
  const toggleSprings = () => store.set({ overlay: store.state.overlay === 'springs' ? 'none' : 'springs' });
  const springs = new SpringsLegend(toggleSprings, () => play.setForm('lattice'));
  listenToKeys(store, hand, stage.orbit, {
    pause: () => play.togglePause(),
    frame,
    springs: toggleSprings,
    xray: () => store.set({ overlay: store.state.overlay === 'xray' ? 'none' : 'xray' }),
    help: () => store.set({ helpOpen: true }),
    busy: () => help.open || isControl(document.activeElement),
  });
  const showLegends = () => {
    springs.show(store.state.overlay === 'springs', store.state.form.value === 'lattice' ? stage.forces.end : null);
    overlay.showLegend();
  };
  store.subscribe(['overlay'], showLegends);

  play.start(options);
  stage.run(hand, {
    springs: () => store.state.overlay === 'springs',
    holders: () => hand.holders()?.bodies ?? [],
    update: () => toolbar.showCarrying(hand.carries),
    readout() {
      readouts.show();
      showLegends();
      toolbar.showPlaceable(hand.canPlace());
    },
    follow: (moved, now) => labels.follow(stage.bodies!, stage.orbit, moved, now),
  });
  window.teeter = createInspect({ store, stage, hand, pointers, labels, client: play.client });

  function createStage(): Stage | null {
    try {
      return new Stage(options, store);
    } catch {
      return null;
    }
  }
}

/** Returns true for a control that takes keys. */
function isControl(active: Element | null): boolean {
  return active instanceof HTMLInputElement || active instanceof HTMLSelectElement;
}

start();
