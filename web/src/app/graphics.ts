// Loss of the graphics: the browser may take the WebGL context away, as when a driver restarts, and
// give it back later. The physics goes on meanwhile.

import { text } from '../messages';
import { showTrouble, type Notice } from '../ui/notice';
import type { Stage } from './stage';

/** Time after which a lost context is not expected back, s. */
const PATIENCE = 15;

const LOST = text.notices.graphicsLost;

/** Says when the graphics are lost, and draws again when they are back. */
export function followGraphics(stage: Stage, notice: Notice): void {
  let timer = 0;
  // three.js listens as well, and builds its resources again; its listeners come first.
  stage.canvas.addEventListener('webglcontextlost', () => {
    notice.hold(LOST);
    timer = window.setTimeout(() => showTrouble(text.trouble.graphicsGone), PATIENCE * 1000);
  });
  stage.canvas.addEventListener('webglcontextrestored', () => {
    clearTimeout(timer);
    notice.release(LOST);
    stage.redraw();
  });
}
