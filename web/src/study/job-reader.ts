// Reads messages to a worker that studies. One of another form is refused before it reaches the
// engine.

import * as v from 'valibot';
import { address, bytes, command, index, readBy, rules, setup } from '../engine/message-reader';
import type { Job, ToStudy } from './jobs';

const seconds = v.pipe(v.number(), v.minValue(0));
const move = v.object({ scene: v.string(), rules, commands: v.array(command), fell: v.boolean(), placed: v.boolean() });

const job: v.GenericSchema<Job> = v.variant('kind', [
  v.object({ kind: v.literal('think'), seconds, state: bytes, question: v.string() }),
  v.object({ kind: v.literal('tower'), seconds, state: bytes, rules: v.string(), budget: index }),
  v.object({ kind: v.literal('record'), seconds, bytes, budget: index }),
  v.object({ kind: v.literal('verify'), seconds, bytes, engines: address, setup }),
  v.object({ kind: v.literal('cut'), seconds, move }),
]);

const message: v.GenericSchema<ToStudy> = v.variant('type', [
  v.object({ type: v.literal('run'), id: index, job }),
  v.object({ type: v.literal('stop'), id: index }),
]);

/** Reads a message to such a worker. Throws an Error that names the field where it is none. */
export function readStudyMessage(data: unknown): ToStudy {
  return readBy(message, data);
}

/** Id of a message that may be a job; null for another. */
export function jobId(data: unknown): number | null {
  const { success, output } = v.safeParse(v.object({ id: index }), data);
  return success ? output.id : null;
}
