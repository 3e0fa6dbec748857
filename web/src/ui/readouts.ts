// Numbers about the game, and the line beneath the title.

import { SLOW } from '../app/slow-motion';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import { text } from '../messages';
import { modeOf } from '../modes';
import { element, setText } from './dom';

export class Readouts {
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
  ) {}

  show(): void {
    const { frame, paused, panelOpen, match, speed } = this.store.state;
    const blocks = this.stage.bodies?.count ?? 0;
    const status = frame
      ? modeOf(match.mode).overlay(frame.update, blocks, match).status
      : text.readouts.blocks(blocks);
    setText('state', paused ? text.readouts.paused(blocks) : status);
    setText('fps', text.readouts.fps(this.stage.fps));
    // A slow motion that the page asks for is no fault of the device.
    const factor = (frame?.factor ?? speed) / speed;
    const slow = !paused && factor < SLOW;
    setText('factor', slow ? text.readouts.slow(factor) : text.readouts.real(factor));
    element('factor').classList.toggle('slow', slow);
    if (!panelOpen) return;
    const report = frame?.update.report;
    setText('n-blocks', String(blocks));
    setText('n-awake', String(report?.awake ?? 0));
    setText('n-time', text.readouts.seconds(report?.time ?? 0, 1));
    setText('n-capacity', text.readouts.speed(frame?.capacity ?? 1));
    setText('n-overlap', text.readouts.millimetres((report?.penetration ?? 0) * 1000, 3));
    setText('n-quality', text.readouts.quality[this.stage.quality.tier.name]);
  }
}
