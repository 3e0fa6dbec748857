// Computes the waves of the instrument, which takes a tenth of a second: too long for the page.

import { wavesAt } from './waves';

self.onmessage = ({ data: rate }: MessageEvent<number>) => {
  const waves = wavesAt(rate);
  self.postMessage(waves, { transfer: Object.values(waves).map(wave => wave.buffer) });
};
