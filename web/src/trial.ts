// The trial: one frame of a full tower on the real engine, again and again, for the clock to tell what it costs.

import { measureForm, TRIAL } from './device';
import { FRAME, type Form } from './protocol';
import { sceneText } from './simulator';
import { Simulation } from './wasm/teeter_wasm.js';

/** Frames before the one that is tried: gravity then begins to press the blocks together, and all of them are detected again. */
const LEAD = 4;

/** Cost of the trial's frame with blocks of a form on this device, s, by the clock `now`, s. */
export function trial(form: Form, now: () => number): number {
  const { rows, stiffness } = TRIAL;
  const scene = sceneText({ kind: 'tower', rows, seed: 1, block: 'dissertation' }, () => ({
    form,
    stiffness,
    springs: null,
  }));
  const simulation = new Simulation(scene, JSON.stringify({ sleep: false, frame: FRAME }));
  try {
    for (let i = 0; i < LEAD; i++) simulation.step('');
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
