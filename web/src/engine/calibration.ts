// Measures the cost of one frame of a full tower on this device.

import { Simulation } from '../wasm/teeter_wasm.js';
import { CALIBRATION, measureForm } from './device';
import { FRAME, type Form } from './game-protocol';
import { sceneText } from './scene';

/**
 * Frames before the measured one: gravity then begins to press the blocks together, and all
 * contacts are detected again.
 */
const WARM_UP = 4;

/** Returns the cost of the calibration frame with blocks of a form, s, by the clock `now`, s. */
export function calibrate(form: Form, now: () => number): number {
  const { rows, stiffness } = CALIBRATION;
  const scene = sceneText({ kind: 'tower', rows, seed: 1, block: 'dissertation' }, () => ({
    form,
    stiffness,
    springs: null,
  }));
  const simulation = new Simulation(scene, JSON.stringify({ sleep: false, frame: FRAME }));
  try {
    for (let i = 0; i < WARM_UP; i++) simulation.step('');
    const state = simulation.snapshot();
    const step = () => {
      simulation.restore(state);
      simulation.step('');
    };
    return measureForm(form, step, now);
  } finally {
    simulation.free();
  }
}
