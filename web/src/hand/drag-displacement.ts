// Displacement of the hand's target for a drag on the screen, for each grip.

import { Vector3 } from 'three';
import type { HandUpdate } from '../engine/game-protocol';
import type { Orbit } from '../view/orbit';
import { axisDisplacement, slideDisplacement, type ProjectedAxis, type ScreenVector } from './screen-to-world';

const UP = new Vector3(0, 0, 1);
/** Elevation above which a block is carried in a level plane, rad. */
const STEEP = 0.95;
/** Length over which a direction is projected, m. */
const STEP = 0.005;

/**
 * Returns the displacement for a drag (px), m: along the axes of the hand, or anywhere without
 * axes.
 */
export function dragDisplacement(orbit: Orbit, hand: HandUpdate, drag: ScreenVector): Vector3 {
  const goal = new Vector3(...hand.goal);
  const [along, across] = hand.axes.map(axis => new Vector3(...axis));
  if (!along) return carry(orbit, goal, drag);
  const scale = orbit.scaleAt(goal);
  const first = projected(orbit, goal, along);
  if (!across) return along.multiplyScalar(axisDisplacement(drag, first, scale));
  const slide = slideDisplacement(drag, first, projected(orbit, goal, across), scale);
  return along.multiplyScalar(slide.along).addScaledVector(across, slide.across);
}

/**
 * A block is carried in the upright plane that faces the viewer, or in a level plane where the view
 * is from above.
 */
function carry(orbit: Orbit, goal: Vector3, drag: ScreenVector): Vector3 {
  const scale = orbit.scaleAt(goal);
  const forward = orbit.forward();
  const flat = forward.clone().setZ(0).normalize();
  const steep = orbit.elevation > STEEP;
  const gain = 1 / Math.max(0.5, steep ? Math.abs(forward.z) : Math.hypot(forward.x, forward.y));
  return flat
    .clone()
    .cross(UP)
    .multiplyScalar(drag.x / scale)
    .addScaledVector(steep ? flat : UP, (-drag.y * gain) / scale);
}

function projected(orbit: Orbit, point: Vector3, direction: Vector3): ProjectedAxis {
  const a = orbit.project(point);
  const b = orbit.project(point.clone().addScaledVector(direction, STEP));
  return {
    screen: { x: (b.x - a.x) / STEP, y: (b.y - a.y) / STEP },
    towards: -direction.dot(orbit.forward().setZ(0).normalize()),
  };
}
