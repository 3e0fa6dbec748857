// Reads messages to the workers of the museum. One of another form is refused before it reaches a
// simulator.

import * as v from 'valibot';
import { command, index, question, readBy, real, seed, vec, watched } from '../engine/message-reader';
import type { MuseumQuestion, MuseumSetup, PlaneSetup, Request2003, ToMuseum, ToPlane } from './protocol';

/** Constants that a message may name, and the length of each name and value. */
const MAX_CONSTANTS = 1000;
const short = v.pipe(v.string(), v.maxLength(1000));
const constants = v.pipe(v.record(short, short), v.maxEntries(MAX_CONSTANTS));

const setup: v.GenericSchema<MuseumSetup> = v.object({
  show: v.picklist(['old', 'engine', 'both']),
  scene: v.nullable(v.string()),
  rows: real,
  seed,
  constants,
});

const pointer = v.object({ origin: vec, direction: vec, toward_viewer: vec });

const request: v.GenericSchema<Request2003> = v.variant('request', [
  v.object({ request: v.picklist(['pick', 'drag', 'resume']), pointer }),
  v.object({ request: v.literal('pull'), distance: real, toward_viewer: vec }),
  v.object({ request: v.literal('release') }),
]);

const asked: v.GenericSchema<MuseumQuestion> = v.variant('what', [
  question,
  v.object({ what: v.literal('constants') }),
  v.object({ what: v.literal('set'), values: constants }),
]);

const toMuseum: v.GenericSchema<ToMuseum> = v.variant('type', [
  v.object({ type: v.literal('build'), world: index, setup }),
  v.object({ type: v.literal('command'), world: index, number: index, command }),
  v.object({ type: v.literal('pause'), paused: v.boolean() }),
  v.object({ type: v.literal('watch'), watched }),
  v.object({ type: v.literal('request'), world: index, request }),
  v.object({ type: v.literal('ask'), id: index, question: asked }),
]);

/**
 * Reads a message to the worker of the tower. Throws an Error that names the field where it is
 * none.
 */
export function readToMuseum(data: unknown): ToMuseum {
  return readBy(toMuseum, data);
}

const planeSetup: v.GenericSchema<PlaneSetup> = v.object({
  method: v.picklist(['springs', 'constraint', 'penalty', 'micro-collisions']),
  setting: v.picklist(['stack', 'falling', 'tower']),
  count: index,
  gap: real,
  stiffness: v.nullable(real),
});
/** Positions and velocities in the picture, far beyond its edge. */
const near = v.pipe(v.number(), v.minValue(-1000), v.maxValue(1000));
const position = { x: near, y: near };

const toPlane: v.GenericSchema<ToPlane> = v.variant('type', [
  v.object({ type: v.literal('build'), scene: index, setup: planeSetup }),
  v.object({ type: v.literal('speed'), speed: v.pipe(v.number(), v.minValue(0), v.maxValue(1000)) }),
  v.object({ type: v.literal('single') }),
  v.object({ type: v.literal('hold'), ...position }),
  v.object({ type: v.literal('drag'), ...position }),
  v.object({ type: v.literal('release') }),
  v.object({ type: v.literal('add'), ...position, vx: near, vy: near }),
]);

/**
 * Reads a message to the worker of an exhibit. Throws an Error that names the field where it is
 * none.
 */
export function readToPlane(data: unknown): ToPlane {
  return readBy(toPlane, data);
}
