// The blocks change in small steps, and reach their target.

import { expect, test } from 'vitest';
import type { Blocks } from '../../src/hand/control/simulator';
import { StiffnessRamp } from '../../src/hand/control/stiffness-ramp';

/** Returns all steps of a ramp to its target. */
function steps(ramp: StiffnessRamp): Blocks[] {
  const all: Blocks[] = [];
  for (let next = ramp.next(); next; next = ramp.next()) {
    all.push(next);
    expect(all.length).toBeLessThan(1000);
  }
  return all;
}

function smooth(blocks: Blocks[]): void {
  blocks.slice(1).forEach(({ springs }, i) => {
    const factor = springs / blocks[i].springs;
    expect(Math.max(factor, 1 / factor)).toBeLessThan(1.061);
  });
}

test('blocks at their target do not change', () => {
  expect(steps(new StiffnessRamp({ form: 'rigid', springs: 1e6 }, 1e6))).toEqual([]);
  expect(steps(new StiffnessRamp({ form: 'lattice', springs: 1e3 }, 1e6))).toEqual([]);
});

test('between rigid blocks and springs as stiff as the contacts there is one step', () => {
  const ramp = new StiffnessRamp({ form: 'rigid', springs: 1e6 }, 1e6);
  ramp.setTarget({ form: 'lattice', springs: 1e6 });
  expect(steps(ramp)).toEqual([{ form: 'lattice', springs: 1e6 }]);
  ramp.setTarget({ form: 'rigid', springs: 1e6 });
  expect(steps(ramp)).toEqual([{ form: 'rigid', springs: 1e6 }]);
});

test('soft springs come and go through stiff ones, by a small factor a step', () => {
  const ramp = new StiffnessRamp({ form: 'rigid', springs: 1e6 }, 3e5);
  ramp.setTarget({ form: 'lattice', springs: 1e3 });
  const down = steps(ramp);
  expect(down[0]).toEqual({ form: 'lattice', springs: 1e6 });
  expect(down.at(-1)).toEqual({ form: 'lattice', springs: 1e3 });
  smooth(down);
  ramp.setTarget({ form: 'rigid', springs: 1e3 });
  const up = steps(ramp);
  expect(up.at(-2)).toEqual({ form: 'lattice', springs: 1e6 });
  expect(up.at(-1)!.form).toBe('rigid');
  smooth([{ form: 'lattice', springs: 1e3 }, ...up.slice(0, -1)]);
});

test('a new target during the ramp is followed from the current stiffness', () => {
  const ramp = new StiffnessRamp({ form: 'lattice', springs: 1e6 }, 1e6);
  ramp.setTarget({ form: 'lattice', springs: 1e3 });
  const first = [ramp.next()!, ramp.next()!];
  ramp.setTarget({ form: 'lattice', springs: 3e6 });
  const all = [...first, ...steps(ramp)];
  smooth(all);
  expect(all.at(-1)).toEqual({ form: 'lattice', springs: 3e6 });
});

test('springs stiffer than the contacts need not soften to become rigid', () => {
  const ramp = new StiffnessRamp({ form: 'lattice', springs: 3e7 }, 1e6);
  ramp.setTarget({ form: 'rigid', springs: 3e7 });
  expect(steps(ramp)).toEqual([{ form: 'rigid', springs: 3e7 }]);
});
