// Devices of the player beside pointers: keys and gamepads steer the hand, and what happens is felt
// and said.

import { Gamepads } from '../hand/gamepad';
import { Haptics } from '../hand/haptics';
import { Steering, sumOf } from '../hand/steering';
import { SteeringKeys } from '../hand/steering-keys';
import { text } from '../messages';
import { Announcer } from '../ui/announcer';
import type { Play } from './play';
import { listenToKeys } from './shortcuts';
import type { Stage } from './stage';
import type { PageStore } from './state';

/**
 * Connects the devices, and returns the gamepads, which are to be polled. `hint` shows the safest
 * block.
 */
export function connectDevices(store: PageStore, stage: Stage, play: Play, hint: () => void): Gamepads {
  const { hand } = play;
  const announcer = new Announcer();
  const chosen = (body: number, height: number) => announcer.say(text.hand.chosen(body, 1000 * height));
  const steering = new Steering(store, hand, stage.orbit, () => stage.bodies, chosen);
  const keys = new SteeringKeys(steering, hand);
  const actions = { pause: () => play.togglePause(), frame: () => stage.frame(), busy: isBusy };
  const pads = new Gamepads(store, hand, steering, stage.orbit, actions);
  const haptics = new Haptics(store);
  store.subscribe(['frame'], ({ frame }) => {
    if (!frame) return;
    steering.step(sumOf(keys.steer, pads.steer));
    haptics.receive(frame);
    announcer.receive(frame);
  });
  listenToKeys(store, hand, stage.orbit, {
    ...actions,
    springs: () => store.set({ overlay: store.state.overlay === 'springs' ? 'none' : 'springs' }),
    xray: () => store.set({ overlay: store.state.overlay === 'xray' ? 'none' : 'xray' }),
    mute: () => store.set({ muted: !store.state.muted }),
    help: () => store.set({ helpOpen: true }),
    hint,
    menu: () => store.set({ menuOpen: true }),
    steer: key => keys.action(key),
    escape: () => keys.escape(),
  });
  return pads;
}

/** Returns true while keys belong to a dialog or a control. */
function isBusy(): boolean {
  const { activeElement } = document;
  const isControl = activeElement instanceof HTMLInputElement || activeElement instanceof HTMLSelectElement;
  return isControl || document.querySelector('dialog[open]') !== null;
}
