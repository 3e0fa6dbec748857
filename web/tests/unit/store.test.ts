// The store notifies those whose fields have changed, once for each change.

import { expect, test } from 'vitest';
import { Store } from '../../src/app/store';

test('a listener is called at once, and after a change of its fields alone', () => {
  const store = new Store({ a: 1, b: 2, c: 3 });
  const seen: number[] = [];
  store.subscribe(['a', 'b'], ({ a, b }) => seen.push(a + b));
  store.set({ c: 4 });
  store.set({ a: 1 });
  store.set({ a: 5, b: 6 });
  expect(seen).toEqual([3, 11]);
  expect(store.state).toEqual({ a: 5, b: 6, c: 4 });
});
