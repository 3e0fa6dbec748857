// A game whose hand is controlled here, for any simulator.

import { FRAME, type GameCommand, type GameEvent, type Update } from '../../engine/game-protocol';
import { Bodies } from '../../view/bodies';
import { FallDetector } from './fall-detector';
import { HandControl } from './hand-control';
import { settlement } from './settlement';
import type { Simulator } from './simulator';
import { slotUpdate } from './slots';

export class ControlledGame {
  private readonly bodies: Bodies;
  private readonly hand: HandControl;
  private readonly falls: FallDetector;
  private fell = false;

  constructor(private readonly simulator: Simulator) {
    this.bodies = new Bodies(simulator.sizes, Float32Array.from(simulator.poses()), simulator.particleOffset);
    this.hand = new HandControl(simulator, this.bodies);
    this.falls = new FallDetector(this.bodies.newest);
  }

  /** Applies a command and steps by a frame. */
  step(command: GameCommand): Update {
    const { simulator } = this;
    const events: GameEvent[] = [];
    this.apply(command, events);
    const report = simulator.step(this.hand.advance(FRAME));
    this.bodies.arrive(Float32Array.from(simulator.poses()), simulator.deformed());
    const held = this.hand.hold?.body ?? null;
    this.hand.observe(report, events);
    const descent = settlement(this.bodies, this.falls.heights);
    const tower = this.falls.advance(this.bodies.newest, report.time, report.max_speed, held, descent);
    const fallen = this.falls.bodies;
    if (fallen.length > 0 && !this.fell) events.push({ event: 'fell', bodies: fallen });
    this.fell = fallen.length > 0;
    return {
      report,
      hand: this.hand.update(),
      slots: this.hand.slots.map(slotUpdate),
      tower,
      fallen,
      quarantined: [],
      at_rest: false,
      form: 'lattice',
      spring_stiffness: null,
      events,
    };
  }

  canPlace(body: number): boolean {
    return this.hand.canPlace(body);
  }

  private apply(command: GameCommand, events: GameEvent[]): void {
    const reason = this.hand.apply(command, events);
    if (reason) events.push({ event: 'refused', reason });
  }
}
