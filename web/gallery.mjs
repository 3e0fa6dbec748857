// Draws the pictures of the gallery, public/gallery/*.webp, with `teeter render`. Run it when a
// scene or the wood of the blocks has changed: node gallery.mjs [TEETER]

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { chromium } from 'playwright-core';

const EXECUTABLE = process.env.CHROMIUM ?? '/usr/bin/chromium';
const TEETER = process.argv[2] ?? '../target/release/teeter';
const SIZE = '384x256';
const QUALITY = 0.82;
/** Pictures by name: the arguments of `teeter render`. */
const PICTURES = {
  tower: ['tower'],
  midgame: ['midgame'],
  cards: ['cards'],
  dominoes: ['dominoes'],
  arch: ['arch', '--camera', '-75,14'],
  lire: ['lire'],
  wall: ['wall'],
  'see-saw': ['see-saw'],
  slope: ['slope'],
  field: ['field'],
  pile: ['pile', '--at', '1.2', '--camera', '-54,22,0.75,0,0,0.04'],
  museum: ['moves'],
};

const folder = new URL('public/gallery/', import.meta.url);
mkdirSync(folder, { recursive: true });
const drawn = mkdtempSync(`${tmpdir()}/teeter-gallery-`);
const browser = await chromium.launch({ executablePath: EXECUTABLE, args: ['--no-sandbox'] });
const page = await browser.newPage();
for (const [name, options] of Object.entries(PICTURES)) {
  const file = `${drawn}/${name}.png`;
  execFileSync(TEETER, ['render', ...options, '--size', SIZE, '--out', file]);
  const webp = await page.evaluate(
    async ([png, quality]) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
      const canvas = new OffscreenCanvas(image.width, image.height);
      canvas.getContext('2d').drawImage(image, 0, 0);
      const blob = await canvas.convertToBlob({ type: 'image/webp', quality });
      return [...new Uint8Array(await blob.arrayBuffer())];
    },
    [readFileSync(file).toString('base64'), QUALITY],
  );
  writeFileSync(new URL(`${name}.webp`, folder), Uint8Array.from(webp));
}
await browser.close();
rmSync(drawn, { recursive: true });
