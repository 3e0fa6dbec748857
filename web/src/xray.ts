// The X-ray: what each block carries and how hard it must be pulled to start, as numbers and colours. No drawing and no document here.

import type { Bodies } from './bodies';
import { Vector3 } from 'three';

/** Numbers a body in an X-ray: normal force on its upper face, force that starts it sliding (N; NaN where nothing bears it). */
export const XRAY_STRIDE = 2;
/** A block that starts below this is loose, N: its own weight is held by less, and little else is. */
export const LOOSE = 0.1;
/** Force at which the scale of colours ends, N. It begins at [`LOOSE`] and goes with the logarithm. */
export const END = 10;
/** Forces that the legend names, N. */
export const TICKS = [0.1, 0.3, 1, 3, 10];
/** Sine of the lean up to which a block is said to lie: a pull along it takes at most a tenth of its weight more one way than the other. */
const LEANING = 0.1;

/** From loose to tight: viridis from its end, whose lightness falls evenly whatever one's colour vision. */
const RAMP = [
  '#fde725',
  '#b5de2b',
  '#6ece58',
  '#35b779',
  '#1f9e89',
  '#26828e',
  '#31688e',
  '#3e4989',
  '#482878',
  '#440154',
];
/** Of blocks to which it does not apply. */
export const NO_COLOUR = '#8b857e';
/** Place on the scale from which a block is dark enough for light figures. */
const DARK = 0.4;

/** The colours of the scale as a gradient of CSS. */
export const GRADIENT = `linear-gradient(to right, ${RAMP.join(', ')})`;

/** Place of a force (N) on the scale, 0 to 1. */
export function placeOf(force: number): number {
  return Math.min(1, Math.max(0, Math.log(force / LOOSE) / Math.log(END / LOOSE)));
}

/** Colour of a block that starts at a force (N), red, green and blue from 0 to 1 as on the screen. */
export function colourOf(force: number): [number, number, number] {
  const at = placeOf(force) * (RAMP.length - 1);
  const from = Math.min(RAMP.length - 2, Math.floor(at));
  const [a, b] = [RAMP[from], RAMP[from + 1]].map(channels);
  return [0, 1, 2].map(k => a[k] + (at - from) * (b[k] - a[k])) as [number, number, number];
}

/** A colour `#rrggbb` as three numbers from 0 to 1. */
export function channels(hex: string): [number, number, number] {
  return [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16) / 255) as [number, number, number];
}

/** Whether figures on a block that starts at a force (N) must be light. */
export function isDark(force: number): boolean {
  return placeOf(force) > DARK;
}

/** A force for people, N: hundredths below one newton, tenths above. */
export function forceText(force: number): string {
  return force.toFixed(force < 0.995 ? 2 : force < 9.95 ? 1 : 0);
}

export interface Reading {
  /** Normal force on the upper face, N. */
  load: number;
  /** Force along it that starts it, N; null where that says nothing: it does not lie, or on nothing. */
  pull: number | null;
}

/** What the X-ray of a tower at rest says of each block. */
export function readings(xray: ArrayLike<number>, bodies: Bodies): Reading[] {
  return Array.from({ length: bodies.count }, (_, body) => {
    const [load, pull] = [xray[XRAY_STRIDE * body], xray[XRAY_STRIDE * body + 1]];
    return { load, pull: Number.isNaN(pull) || !lies(bodies, body) ? null : pull };
  });
}

export function isLoose({ pull }: Reading): boolean {
  return pull !== null && pull < LOOSE;
}

/** Whether a block lies on one of its faces, its long axis level. */
function lies(bodies: Bodies, body: number): boolean {
  const turn = bodies.turn(body, bodies.newest);
  const size = bodies.size(body);
  const heights = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map(axis =>
    Math.abs(axis.applyQuaternion(turn).z),
  );
  const long = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : size.y >= size.z ? 1 : 2;
  return heights[long] < LEANING && heights.filter((_, k) => k !== long).some(height => height < LEANING);
}
