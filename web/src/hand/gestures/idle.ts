// No block is touched.

import type { GestureState } from './gesture';

export const idle: GestureState = { name: 'idle' };
