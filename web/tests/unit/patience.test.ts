import { expect, test } from 'vitest';
import { Patience } from '../../src/app/patience';

test('what is waited for is late after two seconds, and no longer when it has come', () => {
  const patience = new Patience();
  expect(patience.late(100)).toBeNull();
  patience.begin('world', 10);
  expect(patience.late(11.9)).toBeNull();
  expect(patience.late(12.1)).toBe('world');
  patience.begin('step', 12.2);
  expect(patience.late(14.1)).toBeNull();
  expect(patience.late(14.3)).toBe('step');
  patience.end();
  expect(patience.late(1000)).toBeNull();
});
