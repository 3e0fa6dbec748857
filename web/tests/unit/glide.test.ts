// Blocks change in steps that a standing tower bears, and end as they were wanted.

import { expect, test } from 'vitest';
import { Glide, type Blocks } from '../../src/glide';

/** All that a glide makes of the blocks, until it rests. */
function way(glide: Glide): Blocks[] {
  const all: Blocks[] = [];
  for (let next = glide.next(); next; next = glide.next()) {
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

test('blocks that are as wanted stay', () => {
  expect(way(new Glide({ form: 'rigid', springs: 1e6 }, 1e6))).toEqual([]);
  expect(way(new Glide({ form: 'lattice', springs: 1e3 }, 1e6))).toEqual([]);
});

test('between rigid blocks and springs as stiff as the contacts there is one step', () => {
  const glide = new Glide({ form: 'rigid', springs: 1e6 }, 1e6);
  glide.want({ form: 'lattice', springs: 1e6 });
  expect(way(glide)).toEqual([{ form: 'lattice', springs: 1e6 }]);
  glide.want({ form: 'rigid', springs: 1e6 });
  expect(way(glide)).toEqual([{ form: 'rigid', springs: 1e6 }]);
});

test('soft springs come and go through stiff ones, by a small factor a step', () => {
  const glide = new Glide({ form: 'rigid', springs: 1e6 }, 3e5);
  glide.want({ form: 'lattice', springs: 1e3 });
  const down = way(glide);
  expect(down[0]).toEqual({ form: 'lattice', springs: 1e6 });
  expect(down.at(-1)).toEqual({ form: 'lattice', springs: 1e3 });
  smooth(down);
  glide.want({ form: 'rigid', springs: 1e3 });
  const up = way(glide);
  expect(up.at(-2)).toEqual({ form: 'lattice', springs: 1e6 });
  expect(up.at(-1)!.form).toBe('rigid');
  smooth([{ form: 'lattice', springs: 1e3 }, ...up.slice(0, -1)]);
});

test('a wish on the way is followed from where the springs are', () => {
  const glide = new Glide({ form: 'lattice', springs: 1e6 }, 1e6);
  glide.want({ form: 'lattice', springs: 1e3 });
  const first = [glide.next()!, glide.next()!];
  glide.want({ form: 'lattice', springs: 3e6 });
  const all = [...first, ...way(glide)];
  smooth(all);
  expect(all.at(-1)).toEqual({ form: 'lattice', springs: 3e6 });
});

test('springs stiffer than the contacts need not soften to become rigid', () => {
  const glide = new Glide({ form: 'lattice', springs: 3e7 }, 1e6);
  glide.want({ form: 'rigid', springs: 3e7 });
  expect(way(glide)).toEqual([{ form: 'rigid', springs: 3e7 }]);
});
