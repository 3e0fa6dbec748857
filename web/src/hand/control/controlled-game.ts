// A game whose hand is controlled here, for any simulator.

import { FRAME, type GameCommand, type GameEvent, type Update } from '../../engine/game-protocol';
import { Bodies } from '../../view/bodies';
import { FallDetector } from './fall-detector';
import { HandControl } from './hand-control';
import { RestDetector } from './rest-detector';
import { settlement } from './settlement';
import type { Simulator } from './simulator';
import { slotUpdate } from './slots';
import { StiffnessRamp } from './stiffness-ramp';

export class ControlledGame {
  private readonly bodies: Bodies;
  private readonly hand: HandControl;
  private readonly falls: FallDetector;
  private readonly rest = new RestDetector();
  private readonly ramp: StiffnessRamp;
  private readonly quarantined = new Set<number>();
  private fell = false;

  constructor(private readonly simulator: Simulator) {
    const { form, stiffness, springStiffness } = simulator;
    this.bodies = new Bodies(simulator.sizes, Float32Array.from(simulator.poses()), simulator.particleOffset);
    this.hand = new HandControl(simulator, this.bodies);
    this.falls = new FallDetector(this.bodies.newest);
    this.ramp = new StiffnessRamp({ form, springs: springStiffness ?? stiffness }, stiffness);
  }

  /** Applies a command and steps by a frame. */
  step(command: GameCommand): Update {
    const { simulator } = this;
    const events: GameEvent[] = [];
    this.apply(command, events);
    const blocks = this.ramp.next();
    if (blocks) simulator.setBlocks?.(blocks);
    const report = simulator.step(this.hand.advance(FRAME));
    for (const body of report.quarantined) this.quarantined.add(body);
    report.quarantined = [...this.quarantined];
    this.bodies.arrive(Float32Array.from(simulator.poses()), simulator.deformed());
    const held = this.hand.hold?.body ?? null;
    this.hand.observe(report, events);
    const { form, springStiffness: springs } = simulator;
    if (simulator.contactForces) {
      const motion = { speed: report.max_speed, held: held !== null, form, springs };
      this.rest.advance(motion, () => simulator.contactForces!());
    }
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
      at_rest: this.rest.atRest,
      form,
      spring_stiffness: springs,
      events,
    };
  }

  canPlace(body: number): boolean {
    return this.hand.canPlace(body);
  }

  private apply(command: GameCommand, events: GameEvent[]): void {
    if (command.command === 'set_blocks') {
      const springs = command.spring_stiffness ?? this.simulator.stiffness;
      this.ramp.setTarget({ form: command.form, springs });
      return;
    }
    const reason = this.hand.apply(command, events);
    if (reason) events.push({ event: 'refused', reason });
  }
}
