// Draws the icons of the installed page, public/icon-*.png, from public/icon.svg. Run it when the
// drawing has changed: node icons.mjs

import { readFileSync, writeFileSync } from 'node:fs';
import { chromium } from 'playwright-core';

const EXECUTABLE = process.env.CHROMIUM ?? '/usr/bin/chromium';
const BACKGROUND = '#e9e2d8';
/** Part of an icon that every mask leaves visible. */
const SAFE = 0.66;

const drawing = readFileSync(new URL('public/icon.svg', import.meta.url), 'utf8');
const browser = await chromium.launch({ executablePath: EXECUTABLE, args: ['--no-sandbox'] });
for (const size of [192, 512]) {
  const page = await browser.newPage({ viewport: { width: size, height: size } });
  const box = `width: ${SAFE * size}px; margin: ${((1 - SAFE) / 2) * size}px`;
  await page.setContent(
    `<body style="margin: 0; background: ${BACKGROUND}; display: flow-root"><div style="${box}">${drawing}</div></body>`,
  );
  writeFileSync(new URL(`public/icon-${size}.png`, import.meta.url), await page.screenshot());
}
await browser.close();
