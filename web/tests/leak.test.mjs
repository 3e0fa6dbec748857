// What is built and freed leaves no memory behind.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { kinds, MAX_GROWTH, measure } from './leak.mjs';

for (const [name, action, exports] of await kinds()) {
  test(`builds of a ${name} leave no memory behind`, () => {
    const { growth } = measure(action, exports, 300);
    assert.ok(growth <= MAX_GROWTH, `memory grew by ${growth}`);
  });
}

test('a build that is not freed is noticed', async () => {
  const [[, , exports]] = await kinds();
  const { growth } = measure(() => exports.__wbindgen_malloc(4000, 1), exports, 300);
  assert.ok(growth > MAX_GROWTH, `${growth}`);
});
