// From a pointer's way on the screen (px, y down) to the way of a hand (m).

export interface ScreenVector {
  x: number;
  y: number;
}

/** How a horizontal direction in space shows on the screen at the grasped point. */
export interface Lever {
  /** Way on the screen per metre, px/m. */
  screen: ScreenVector;
  /** Part of the direction that points to the viewer, -1 to 1. */
  towards: number;
}

/** Part of the way that a direction straight at the viewer takes on the screen: towards the viewer is down. */
const FORESHORTENED = 0.35;
/** Smallest lever, as a part of the full scale: a direction along the view would make metres of pixels. */
const SHORTEST = 0.5;
/** How much the hand prefers the block's long axis to going sideways. */
const RELUCTANCE = 1.5;

function effective({ screen, towards }: Lever, scale: number): ScreenVector {
  const x = screen.x;
  const y = screen.y + FORESHORTENED * scale * towards;
  const length = Math.hypot(x, y);
  if (length < 1e-9) return { x: 0, y: SHORTEST * scale };
  const stretch = Math.max(1, (SHORTEST * scale) / length);
  return { x: x * stretch, y: y * stretch };
}

/**
 * Way along and across a block for a drag of (dx, dy) pixels. `scale`: px per metre of a motion that faces the viewer.
 * Least squares on the screen, with sideways motion made dear.
 */
export function slideWay(
  dx: number,
  dy: number,
  along: Lever,
  across: Lever,
  scale: number,
): { along: number; across: number } {
  const u = effective(along, scale);
  const s = effective(across, scale);
  const uu = u.x * u.x + u.y * u.y;
  const ss = s.x * s.x + s.y * s.y + RELUCTANCE * scale * scale;
  const us = u.x * s.x + u.y * s.y;
  const du = dx * u.x + dy * u.y;
  const ds = dx * s.x + dy * s.y;
  const det = uu * ss - us * us;
  return { along: (ss * du - us * ds) / det, across: (uu * ds - us * du) / det };
}

/** Way along one axis alone. */
export function axisWay(dx: number, dy: number, axis: Lever, scale: number): number {
  const u = effective(axis, scale);
  return (dx * u.x + dy * u.y) / (u.x * u.x + u.y * u.y);
}
