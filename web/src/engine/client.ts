// The page's end of the worker.

import type { GameCommand, TimedReport } from './game-protocol';
import type {
  Answer,
  Built,
  Deliberation,
  Frame,
  FromWorker,
  Question,
  SceneEntry,
  Setup,
  ToWorker,
  Watched,
  XRay,
} from './protocol';

export interface Listener<F extends Frame<TimedReport>> {
  scenes(list: SceneEntry[]): void;
  built(world: Built): void;
  frame(frame: F): void;
  xray?(xray: XRay): void;
  deliberation?(deliberation: Deliberation): void;
  refused(message: string): void;
  failed(message: string): void;
}

/** `S` describes a world to build, `F` a frame. */
export class Client<S = Setup, F extends Frame<TimedReport> = Frame> {
  private readonly open = new Map<number, { resolve(value: unknown): void; reject(error: Error): void }>();
  private questions = 0;
  private commands = 0;
  /** Numbers of the last requested world and of the current one. */
  private requested = 0;
  protected world = 0;
  /** Longest time for which one message of the worker blocked the page, ms. */
  maxMessageTime = 0;

  constructor(
    private readonly worker: Worker,
    private readonly listener: Listener<F>,
  ) {
    this.worker.onmessage = (event: MessageEvent<FromWorker>) => {
      const before = performance.now();
      this.receive(event.data);
      this.maxMessageTime = Math.max(this.maxMessageTime, performance.now() - before);
    };
    this.worker.onerror = event => listener.failed(event.message || 'the worker did not start');
  }

  build(setup: S): void {
    this.send({ type: 'build', world: ++this.requested, setup });
  }

  /** Sends a command and returns its number. */
  command(command: GameCommand): number {
    this.send({ type: 'command', world: this.world, number: ++this.commands, command });
    return this.commands;
  }

  pause(paused: boolean): void {
    this.send({ type: 'pause', paused });
  }

  /** Sets the simulated time per wall time. */
  setSpeed(speed: number): void {
    this.send({ type: 'speed', speed });
  }

  /** Goes to a frame of a replay. */
  seek(frame: number): void {
    this.send({ type: 'seek', world: this.world, frame });
  }

  /** Answers a question of a computer player. */
  decide({ world, player }: Deliberation, considered: string): void {
    this.send({ type: 'decided', world, player, considered });
  }

  watch(watched: Watched): void {
    this.send({ type: 'watch', watched });
  }

  ask<Q extends Question>(question: Q): Promise<Answer<Q>> {
    return this.inquire(question) as Promise<Answer<Q>>;
  }

  /** Asks a question that the worker knows. */
  protected inquire(question: object): Promise<unknown> {
    const id = ++this.questions;
    this.post({ type: 'ask', id, question });
    return new Promise((resolve, reject) => this.open.set(id, { resolve, reject }));
  }

  /** Sends a message that the worker knows. */
  protected post(message: object): void {
    this.worker.postMessage(message);
  }

  private send(message: ToWorker<S>): void {
    this.post(message);
  }

  private receive(message: FromWorker): void {
    switch (message.type) {
      case 'scenes':
        return this.listener.scenes(message.list);
      case 'built':
        this.world = message.world;
        return this.listener.built(message);
      case 'frame':
        if (message.world === this.world) this.listener.frame(message as Frame<TimedReport> as F);
        return;
      case 'xray':
        if (message.world === this.world) this.listener.xray?.(message);
        return;
      case 'deliberation':
        if (message.world === this.world) this.listener.deliberation?.(message);
        return;
      case 'refused':
        return this.listener.refused(message.message);
      case 'failed':
        return this.listener.failed(message.message);
      case 'answer':
        this.close(message.id)?.resolve(message.value);
        return;
      case 'invalid': {
        const error = new Error(message.message);
        const question = message.id === null ? undefined : this.close(message.id);
        if (question) question.reject(error);
        // A fault of the page, of which nothing depends on an answer.
        else console.error(error);
      }
    }
  }

  /** Takes a question from those without an answer. */
  private close(id: number) {
    const question = this.open.get(id);
    this.open.delete(id);
    return question;
  }
}
