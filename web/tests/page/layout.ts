// Problems of the layout of a page: what overlaps, is cut off or leaves the screen.

import type { Page } from 'playwright-core';

/** Elements of a part of the page whose content is wider than they are, or that stick out of it. */
export function wide(page: Page, selector: string): Promise<string[]> {
  return page.evaluate(selector => {
    const part = document.querySelector<HTMLElement>(selector)!;
    const { left, right } = part.getBoundingClientRect();
    return [part, ...part.querySelectorAll<HTMLElement>('*:not(svg *, option)')]
      .filter(e => {
        const box = e.getBoundingClientRect();
        const cut = e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0 && !(e instanceof SVGElement);
        return box.width > 0 && (cut || box.left < left - 0.5 || box.right > right + 0.5);
      })
      .map(e => `${e.tagName} ${e.id} ${e.textContent!.trim().slice(0, 40)}`);
  }, selector);
}

/** Parts of the page that overlap or leave the screen, and buttons that are too small. */
export function findProblems(page: Page, carrying = false): Promise<string[]> {
  return page.evaluate(carrying => {
    const found: string[] = [];
    if (carrying) document.getElementById('carrying')!.hidden = false;
    const shown = [
      ...document.querySelectorAll<HTMLElement>(
        '#title, #legend, #scale, #xray, #readouts, #tools, #panel, #carrying, #menu-open, #turn, #replay, #coach',
      ),
    ]
      .filter(e => e.offsetParent !== null || getComputedStyle(e).position === 'fixed')
      // What the card of the turn stands in for.
      .filter(e => getComputedStyle(e).clipPath === 'none');
    const boxes = shown.filter(e => !e.hidden).map(e => ({ e, name: e.id, box: e.getBoundingClientRect() }));
    for (const { name, box } of boxes)
      if (box.left < 0 || box.top < 0 || box.right > innerWidth + 0.5 || box.bottom > innerHeight + 0.5)
        found.push(`${name} leaves the screen`);
    for (const [i, a] of boxes.entries()) {
      for (const b of boxes.slice(i + 1)) {
        if (a.e.contains(b.e)) continue;
        // On a phone on its side the panel may lie over the title: it is closed again with one
        // tap.
        if (innerHeight < 500 && (a.name === 'panel' || b.name === 'panel')) continue;
        if (
          a.box.left < b.box.right &&
          b.box.left < a.box.right &&
          a.box.top < b.box.bottom &&
          b.box.top < a.box.bottom
        )
          found.push(`${a.name} over ${b.name}`);
      }
    }
    for (const button of document.querySelectorAll<HTMLElement>('button')) {
      const box = button.getBoundingClientRect();
      if (box.width > 0 && (box.width < 43.5 || box.height < 43.5))
        found.push(`${button.id || button.textContent} is ${box.width.toFixed(0)} x ${box.height.toFixed(0)}`);
      if (button.scrollWidth > button.clientWidth + 1) found.push(`${button.id} is too narrow for its text`);
      const bar = button.closest('.bar')?.getBoundingClientRect();
      if (bar && (box.left < bar.left || box.right > bar.right))
        found.push(`${button.textContent} runs over the edge of its bar`);
    }
    if (document.documentElement.scrollWidth > innerWidth || document.documentElement.scrollHeight > innerHeight)
      found.push('the page scrolls');
    return found;
  }, carrying);
}
