// Picture of a scene in the plane: blocks, contact points with their forces, the pull of the
// pointer, and the strip of iterations.

import { barHeight, MAX_BARS, type Chart } from './chart';
import type { PlaneFrame } from './protocol';

/** Width of the picture, and depth of its lower edge below the table, m. */
export const WIDE = 0.3;
const BELOW = 0.008;
/** Fraction of the canvas that the strip takes. */
const STRIP = 0.16;
/** Length of the arrow of a force, m/N. */
const ARROW = 0.015;

export interface Colours {
  ink: string;
  soft: string;
  line: string;
  accent: string;
  push: string;
  wood: string;
  edge: string;
}

export class PlanePicture {
  private readonly context: CanvasRenderingContext2D;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly strip: boolean,
  ) {
    this.context = canvas.getContext('2d')!;
  }

  /** Position in the plane (m) of a position on the canvas (CSS px). */
  positionAt(x: number, y: number): { x: number; y: number } {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const scale = width / WIDE;
    return { x: (x - width / 2) / scale, y: (this.floor(height) - y) / scale };
  }

  /** Position on the canvas (CSS px) of a position in the plane (m). */
  screen(x: number, y: number): { x: number; y: number } {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const scale = width / WIDE;
    return { x: width / 2 + x * scale, y: this.floor(height) - y * scale };
  }

  draw(frame: PlaneFrame, chart: Chart, limit: number, colours: Colours): void {
    const { context, canvas } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    const ratio = Math.min(2, window.devicePixelRatio);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    this.drawTable(width, height, colours);
    this.drawBlocks(frame, colours);
    this.drawContacts(frame, colours);
    this.drawPull(frame, colours);
    if (this.strip) this.drawBars(chart, limit, colours);
  }

  private floor(height: number): number {
    return height * (this.strip ? 1 - STRIP : 1) - (BELOW * this.canvas.clientWidth) / WIDE;
  }

  private drawTable(width: number, height: number, { line, soft }: Colours): void {
    const { context } = this;
    const y = this.floor(height);
    context.fillStyle = line;
    context.fillRect(0, y, width, (BELOW * width) / WIDE);
    context.strokeStyle = soft;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(0, y);
    context.lineTo(width, y);
    context.stroke();
  }

  private drawBlocks({ corners }: PlaneFrame, { wood, edge }: Colours): void {
    const { context } = this;
    context.fillStyle = wood;
    context.strokeStyle = edge;
    context.lineWidth = 1;
    context.lineJoin = 'round';
    for (let at = 0; at < corners.length; at += 8) {
      context.beginPath();
      for (let k = 0; k < 8; k += 2) {
        const { x, y } = this.screen(corners[at + k], corners[at + k + 1]);
        if (k === 0) context.moveTo(x, y);
        else context.lineTo(x, y);
      }
      context.closePath();
      context.fill();
      context.stroke();
    }
  }

  private drawContacts({ contacts }: PlaneFrame, { push }: Colours): void {
    const { context } = this;
    context.fillStyle = context.strokeStyle = push;
    context.lineWidth = 1.6;
    for (let at = 0; at < contacts.length; at += 5) {
      const [px, py, nx, ny, force] = contacts.subarray(at, at + 5);
      const from = this.screen(px, py);
      context.beginPath();
      context.arc(from.x, from.y, 2, 0, 2 * Math.PI);
      context.fill();
      if (force <= 0) continue;
      // Of the pair of forces the one on the upper block.
      const length = ny < 0 ? -ARROW * force : ARROW * force;
      const to = this.screen(px + length * nx, py + length * ny);
      const [dx, dy] = [to.x - from.x, to.y - from.y];
      const pixels = Math.hypot(dx, dy);
      if (pixels < 3) continue;
      const [ux, uy] = [(3.5 * dx) / pixels, (3.5 * dy) / pixels];
      context.beginPath();
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.moveTo(to.x - ux - uy, to.y - uy + ux);
      context.lineTo(to.x, to.y);
      context.lineTo(to.x - ux + uy, to.y - uy - ux);
      context.stroke();
    }
  }

  private drawPull({ held }: PlaneFrame, { accent }: Colours): void {
    if (held.length < 4) return;
    const { context } = this;
    const [from, to] = [this.screen(held[0], held[1]), this.screen(held[2], held[3])];
    context.strokeStyle = context.fillStyle = accent;
    context.lineWidth = 2.5;
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
    context.stroke();
    context.beginPath();
    context.arc(from.x, from.y, 3.5, 0, 2 * Math.PI);
    context.fill();
  }

  private drawBars(chart: Chart, limit: number, { accent, soft, line }: Colours): void {
    const { context } = this;
    const { clientWidth: width, clientHeight: canvasHeight } = this.canvas;
    const tall = canvasHeight * STRIP - 6;
    const bar = width / MAX_BARS;
    context.strokeStyle = line;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(0, canvasHeight - tall);
    context.lineTo(width, canvasHeight - tall);
    context.stroke();
    chart.bars.forEach((value, i) => {
      const fraction = barHeight(value, limit);
      context.fillStyle = value >= limit ? accent : soft;
      context.fillRect(i * bar, canvasHeight - fraction * tall, Math.max(1, bar - 0.5), fraction * tall);
    });
  }
}
