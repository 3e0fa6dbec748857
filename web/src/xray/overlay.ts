// The X-ray on the tower: colours of the blocks and figures on them.

import type { PageStore } from '../app/state';
import type { XRay } from '../engine/protocol';
import type { Hand } from '../hand/hand';
import type { Bodies } from '../view/bodies';
import type { TowerView } from '../view/tower-view';
import { labelOf, stainOf } from './appearance';
import type { Labels } from './labels';
import { XRayLegend } from './legend';
import { readings } from './readings';

/** Opacity of the colours at rest, and while the tower moves. */
const STAIN = { current: 0.92, past: 0.3 };

export class XRayOverlay {
  private readonly legend: XRayLegend;

  constructor(
    private readonly store: PageStore,
    private readonly hand: Hand,
    private readonly view: TowerView,
    private readonly labels: Labels,
  ) {
    const toggle = () => store.set({ overlay: store.state.overlay === 'xray' ? 'none' : 'xray' });
    this.legend = new XRayLegend(toggle);
    store.subscribe(['overlay', 'world'], () => this.clear());
    store.subscribe(['overlay', 'readings', 'paused', 'hovered', 'selected'], () => this.showLegend());
  }

  /**
   * Takes the forces of the worker. While the tower moves there are no figures, and the last
   * colours fade.
   */
  receive({ forces }: XRay, bodies: Bodies): void {
    const { overlay, readings: before } = this.store.state;
    if (overlay !== 'xray') return;
    const next = forces && readings(forces, bodies);
    const coloured = next ?? before;
    this.view.stain(coloured?.map(stainOf) ?? null, next ? STAIN.current : STAIN.past);
    this.labels.set(next?.map(labelOf) ?? null);
    this.store.set({ readings: next });
  }

  showLegend(): void {
    const { overlay, readings, paused, hovered, selected } = this.store.state;
    const body = this.hand.holds ? null : (hovered ?? selected);
    this.legend.show({ on: overlay === 'xray', readings, paused, body, cramped: this.labels.cramped });
  }

  private clear(): void {
    this.store.set({ readings: null });
    this.labels.set(null);
    this.view.stain(null);
  }
}
