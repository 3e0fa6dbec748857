// Converts a drag on the screen (px, y down) to a displacement in space (m).

export interface ScreenVector {
  x: number;
  y: number;
}

/** Projection of a horizontal direction in space at the grasped point. */
export interface ProjectedAxis {
  /** Displacement on the screen per metre, px/m. */
  screen: ScreenVector;
  /** Component of the direction towards the viewer, -1 to 1. */
  towards: number;
}

/**
 * Fraction of the full scale that a direction straight towards the viewer takes on the screen,
 * where it points down.
 */
const FORESHORTENED = 0.35;
/**
 * Smallest length of a projected axis over the full scale: an axis along the view would turn a
 * pixel into metres.
 */
const MIN_LENGTH = 0.5;
/** Cost of sideways motion over that along the block's long axis. */
const SIDEWAYS_COST = 1.5;

function effective({ screen, towards }: ProjectedAxis, scale: number): ScreenVector {
  const x = screen.x;
  const y = screen.y + FORESHORTENED * scale * towards;
  const length = Math.hypot(x, y);
  if (length < 1e-9) return { x: 0, y: MIN_LENGTH * scale };
  const stretch = Math.max(1, (MIN_LENGTH * scale) / length);
  return { x: x * stretch, y: y * stretch };
}

/**
 * Returns the displacement along and across a block for a drag, m: least squares on the screen with
 * a cost on sideways motion. `scale`: px per metre of a motion that faces the viewer.
 */
export function slideDisplacement(
  drag: ScreenVector,
  along: ProjectedAxis,
  across: ProjectedAxis,
  scale: number,
): { along: number; across: number } {
  const u = effective(along, scale);
  const s = effective(across, scale);
  const uu = u.x * u.x + u.y * u.y;
  const ss = s.x * s.x + s.y * s.y + SIDEWAYS_COST * scale * scale;
  const us = u.x * s.x + u.y * s.y;
  const du = drag.x * u.x + drag.y * u.y;
  const ds = drag.x * s.x + drag.y * s.y;
  const det = uu * ss - us * us;
  return { along: (ss * du - us * ds) / det, across: (uu * ds - us * du) / det };
}

/** Returns the displacement along one axis for a drag, m. */
export function axisDisplacement(drag: ScreenVector, axis: ProjectedAxis, scale: number): number {
  const u = effective(axis, scale);
  return (drag.x * u.x + drag.y * u.y) / (u.x * u.x + u.y * u.y);
}
