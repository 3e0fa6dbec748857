// Numbers about the game, and the line beneath the title.

import { SLOW } from '../app/slow-motion';
import type { Stage } from '../app/stage';
import type { PageStore } from '../app/state';
import type { Mode } from '../modes/mode';
import { element, setText } from './dom';

export class Readouts {
  constructor(
    private readonly store: PageStore,
    private readonly stage: Stage,
    private readonly mode: Mode,
  ) {}

  show(): void {
    const { frame, paused, panelOpen } = this.store.state;
    const blocks = this.stage.bodies?.count ?? 0;
    const status = frame ? this.mode.overlay(frame.update, blocks).status : `${blocks} blocks`;
    setText('state', paused ? `Paused · ${blocks} blocks` : status);
    setText('fps', `${this.stage.fps.toFixed(0)} fps`);
    const factor = frame?.factor ?? 1;
    const slow = !paused && factor < SLOW;
    setText('factor', slow ? `slow motion ${factor.toFixed(2)}×` : `real time ${factor.toFixed(2)}×`);
    element('factor').classList.toggle('slow', slow);
    if (!panelOpen) return;
    const report = frame?.update.report;
    setText('n-blocks', String(blocks));
    setText('n-awake', String(report?.awake ?? 0));
    setText('n-time', `${(report?.time ?? 0).toFixed(1)} s`);
    setText('n-capacity', `${(frame?.capacity ?? 1).toFixed(1)}×`);
    setText('n-overlap', `${((report?.penetration ?? 0) * 1000).toFixed(3)} mm`);
    setText('n-quality', this.stage.quality.tier.name);
  }
}
