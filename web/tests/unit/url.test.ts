// Options in the address: invalid values count as absent, and every number stays in its range.

import { expect, test } from 'vitest';
import { readOptions } from '../../src/app/url';

test('an empty address gives the full tower', () => {
  expect(readOptions('')).toMatchObject({
    rows: 18,
    seed: 1,
    block: 'dissertation',
    scene: null,
    sleep: true,
    maxForce: 4,
    render: 'always',
    stiffness: null,
    form: null,
    springs: null,
    scale: 1,
    tier: null,
    help: true,
  });
});

test('a stiffness that the address names is kept in range, and one that makes no sense leaves the choice to the device', () => {
  expect(readOptions('?stiffness=3e5').stiffness).toBe(3e5);
  expect(readOptions('?stiffness=1').stiffness).toBe(1e4);
  expect(readOptions('?stiffness=1e12').stiffness).toBe(1e8);
  for (const text of ['', '=', '=hard', '=NaN']) expect(readOptions(`?stiffness${text}`).stiffness).toBeNull();
});

test('a form and a stiffness of springs that the address names are taken, and nonsense leaves the choice open', () => {
  expect(readOptions('?form=rigid').form).toBe('rigid');
  expect(readOptions('?form=lattice&springs=1e3')).toMatchObject({ form: 'lattice', springs: 1e3 });
  expect(readOptions('?springs=1').springs).toBe(1e3);
  expect(readOptions('?springs=1e12').springs).toBe(1e8);
  expect(readOptions('?form=jelly&springs=soft')).toMatchObject({ form: null, springs: null });
});

test('options are read and kept in range', () => {
  expect(
    readOptions('?rows=7&seed=42&block=official&sleep=0&render=once&scale=0.3&quality=low&help=0&scene=column'),
  ).toMatchObject({
    rows: 7,
    seed: 42,
    block: 'official',
    scene: 'column',
    sleep: false,
    render: 'once',
    scale: 0.3,
    tier: 0,
    help: false,
  });
  expect(readOptions('?rows=1000&seed=-4&scale=99&cap=100')).toMatchObject({
    rows: 40,
    seed: 0,
    scale: 1,
    maxForce: 8,
  });
  expect(readOptions('?rows=many&seed=&block=brick&quality=best')).toMatchObject({
    rows: 18,
    seed: 1,
    block: 'dissertation',
    tier: null,
  });
});
