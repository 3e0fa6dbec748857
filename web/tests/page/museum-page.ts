// The page of the museum in a test: its tower, and a block that can be pulled.

import type { Page } from 'playwright-core';
import { Session, type Host } from './browser';

export const SMALL = 'view=small&scale=0.2';
export async function open(
  chrome: Host,
  query: string,
  options: Parameters<typeof Session.open>[2] = {},
): Promise<Session> {
  const session = await Session.open(chrome, query, { path: 'museum.html', ready: false, ...options });
  await session.page.waitForFunction(() => window.museum?.tower?.ready);
  return session;
}

export const tower = (page: Page) =>
  page.evaluate(() => {
    const { time, show, count, poses, ghost, hand, springs } = window.museum.tower!;
    return { time, show, count, poses, ghost, hand, springs };
  });

/** Waits until the tower's simulated time has gone on by `seconds`. */
export async function simulate(page: Page, seconds: number): Promise<void> {
  const until = (await tower(page)).time + seconds;
  await page.waitForFunction(t => window.museum.tower!.time >= t, until);
}

/**
 * A block between the first and the last row whose end faces the viewer: on the page where it is,
 * and where it goes to come out.
 */
export async function facing(page: Page) {
  const { x, y } = (await page.locator('#picture').boundingBox())!;
  const found = await page.evaluate(() => {
    const t = window.museum.tower!;
    for (let body = t.count - 4; body >= 3; body--) {
      for (const side of [1, -1]) {
        const half = (side * t.sizes[3 * body]) / 2;
        const at = t.screenOf(body, [half, 0, 0]);
        if (t.blockAt(at.x, at.y) !== body || at.y <= t.screenOf(body).y) continue;
        return { body, at, out: t.screenOf(body, [half + side * 0.1, 0, 0]) };
      }
    }
    return null;
  });
  if (!found) return null;
  const onPage = (p: { x: number; y: number }) => ({ x: x + p.x, y: y + p.y });
  return { body: found.body, at: onPage(found.at), out: onPage(found.out) };
}
