// Moves of a player with the mouse: blocks are drawn out by the end that faces the viewer, and put
// on top.

import type { Page } from 'playwright-core';
import { drag, type Session } from './browser';

interface End {
  /** Middle of the end, and a point beyond it as far as the block has to come, CSS px. */
  at: { x: number; y: number };
  out: { x: number; y: number };
}

/** The end of a block that faces the viewer. */
export async function endOf(session: Session, body: number): Promise<End> {
  const end = await session.page.evaluate(body => {
    const { teeter } = window;
    for (const side of [1, -1]) {
      const half = (side * teeter.sizes[3 * body]) / 2;
      const at = teeter.screenOf(body, [half, 0, 0]);
      if (teeter.blockAt(at.x, at.y) !== body || at.y <= teeter.screenOf(body).y) continue;
      return { at, out: teeter.screenOf(body, [half + side * 0.12, 0, 0]) };
    }
    return null;
  }, body);
  if (!end) throw new Error(`no end of block ${body} faces the viewer`);
  return end;
}

/** Draws a block out of the tower and holds it. Returns where the mouse is. */
export async function drawOut(session: Session, body: number): Promise<{ x: number; y: number }> {
  const { at, out } = await endOf(session, body);
  await session.page.mouse.move(at.x, at.y);
  await session.page.mouse.down();
  await drag(session, at, out, 25, 0.04);
  return out;
}

/** Takes a block out of the tower, and lets the hand put it on top. */
export async function takeOut(session: Session, body: number): Promise<void> {
  const { page } = session;
  await drawOut(session, body);
  await page.waitForFunction(() => window.teeter.hand?.grip === 'carry');
  await page.keyboard.press('p');
  await page.mouse.up();
}

/** Waits for the phase of a turn, or for a turn of that number that begins. */
export async function phase(session: Session, name: string, number = 0): Promise<void> {
  const reached = ([name, number]: [string, number]) =>
    window.teeter.turn?.phase === name && window.teeter.turn.number >= number;
  await session.page.waitForFunction(reached, [name, number] as [string, number]);
}

/** Leads the choice to a block, by the direction in which it lies on the screen. */
export async function lead(page: Page, body: number, go: (direction: string) => Promise<unknown>): Promise<void> {
  const visits = new Map<number, number>();
  for (let i = 0; i < 200; i++) {
    const { selected, by } = await page.evaluate(target => {
      const { teeter } = window;
      const [a, b] = [teeter.screenOf(teeter.selected!), teeter.screenOf(target)];
      return { selected: teeter.selected!, by: { x: b.x - a.x, y: b.y - a.y } };
    }, body);
    if (selected === body) return;
    const [across, along] = [by.x > 0 ? 'Right' : 'Left', by.y > 0 ? 'Down' : 'Up'];
    const [first, second] = Math.abs(by.x) > Math.abs(by.y) ? [across, along] : [along, across];
    // Another direction where one has led here before.
    const tries = [first, second, ...['Down', 'Left', 'Up', 'Right'].filter(d => d !== first && d !== second)];
    const visit = visits.get(selected) ?? 0;
    visits.set(selected, visit + 1);
    await go(tries[visit % tries.length]);
  }
  throw new Error(`block ${body} was not reached`);
}
