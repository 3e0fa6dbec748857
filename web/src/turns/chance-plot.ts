// The chance of a fall, move by move, as a plot: bars with the intervals of 95 %, and the riskiest
// move by name.

import { games } from '../messages';
import { nameOf, type Match } from '../modes/match';
import type { MoveChance, RecordReport } from '../study/jobs';
import { create } from '../ui/dom';

const NAMESPACE = 'http://www.w3.org/2000/svg';
/** Size of the plot, and of its margins, in units of the picture. */
const SIZE = { width: 420, height: 120, left: 34, bottom: 18, top: 8 };

/** Returns the plot with a line about the riskiest move; a line alone where no block was taken. */
export function chancePlot(report: RecordReport, match: Match): HTMLElement {
  const { plot } = games;
  const riskiest = report.riskiest === null ? null : report.moves[report.riskiest];
  const line = riskiest
    ? plot.riskiest(nameOf(match, riskiest.player), riskiest.turn, percent(riskiest.chance_of_fall))
    : plot.none;
  const figure = create('figure', { class: 'chances' });
  if (report.moves.length > 0) figure.append(picture(report, match));
  figure.append(create('figcaption', {}, line));
  return figure;
}

function picture({ moves, riskiest }: RecordReport, match: Match): SVGElement {
  const svg = shape('svg', {
    viewBox: `0 0 ${SIZE.width} ${SIZE.height}`,
    role: 'img',
    'aria-label': games.plot.label,
  });
  for (const level of [0, 0.5, 1]) {
    svg.append(shape('path', { class: 'grid', d: `M${SIZE.left} ${y(level)}H${SIZE.width}` }));
    svg.append(shape('text', { x: SIZE.left - 6, y: y(level) + 4, 'text-anchor': 'end' }, `${percent(level)} %`));
  }
  const step = (SIZE.width - SIZE.left) / moves.length;
  moves.forEach((move, k) => svg.append(bar(move, SIZE.left + (k + 0.5) * step, step, k === riskiest, match)));
  return svg;
}

function bar(move: MoveChance, x: number, step: number, marked: boolean, match: Match): SVGElement {
  const width = Math.min(26, 0.62 * step);
  const group = shape('g', { class: marked ? 'move riskiest' : 'move', 'data-player': move.player });
  const { chance_of_fall: chance, low, high } = move;
  const top = y(Math.max(chance, 0.012));
  group.append(
    shape('title', {}, games.plot.move(nameOf(match, move.player), move.turn, percent(chance))),
    shape('rect', { x: x - width / 2, y: top, width, height: y(0) - top, rx: 2 }),
    shape('path', { class: 'interval', d: `M${x} ${y(low)}V${y(high)}` }),
  );
  if (marked) group.append(shape('path', { class: 'mark', d: `M${x} ${y(0) + 3}l5 8h-10z` }));
  return group;
}

function y(chance: number): number {
  return SIZE.top + (1 - chance) * (SIZE.height - SIZE.top - SIZE.bottom);
}

function percent(chance: number): number {
  return Math.round(100 * chance);
}

function shape(tag: string, attributes: Record<string, string | number>, text = ''): SVGElement {
  const node = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  node.textContent = text;
  return node;
}
