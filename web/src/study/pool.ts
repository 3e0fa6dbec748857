// A pool of workers that study towers and records, so that neither the page nor the game waits.

import type { FromStudy, Job, Result, ToStudy } from './jobs';

/** Largest number of workers. */
const MAX_WORKERS = 4;

export interface Running<J extends Job> {
  result: Promise<Result<J>>;
  /** Ends the job: its result so far counts. */
  stop(): void;
}

interface Member {
  worker: Worker;
  jobs: number;
}

export class Pool {
  /** Number of workers: those cores that the page and the game leave. */
  readonly size = Math.max(1, Math.min(MAX_WORKERS, (navigator.hardwareConcurrency || 2) - 1));
  private readonly members: Member[] = [];
  private readonly open = new Map<number, { settle(message: FromStudy): void; progress?(part: number): void }>();
  private ids = 0;

  /** Runs a job on the worker with the fewest. `progress` takes the part that is done. */
  run<J extends Job>(job: J, progress?: (part: number) => void): Running<J> {
    const id = ++this.ids;
    const member = this.member();
    member.jobs += 1;
    const result = new Promise<Result<J>>((resolve, reject) => {
      const settle = (message: FromStudy) => {
        member.jobs -= 1;
        if (message.type === 'failed') reject(new Error(message.message));
        else if (message.type === 'result') resolve(message.value as Result<J>);
      };
      this.open.set(id, { settle, progress });
    });
    const post = (message: ToStudy) => member.worker.postMessage(message);
    post({ type: 'run', id, job });
    return { result, stop: () => post({ type: 'stop', id }) };
  }

  private member(): Member {
    const free = this.members.find(({ jobs }) => jobs === 0);
    if (free) return free;
    if (this.members.length < this.size) return this.hire();
    return this.members.reduce((a, b) => (b.jobs < a.jobs ? b : a));
  }

  private hire(): Member {
    const worker = new Worker(new URL('./study-worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<FromStudy>) => {
      if (data.id === null) return;
      const job = this.open.get(data.id);
      if (data.type === 'progress') {
        job?.progress?.(data.part);
        return;
      }
      this.open.delete(data.id);
      job?.settle(data);
    };
    // A worker that does not start fails all of its jobs.
    worker.onerror = event => {
      for (const [id, job] of this.open) job.settle({ type: 'failed', id, message: event.message });
      this.open.clear();
    };
    const member = { worker, jobs: 0 };
    this.members.push(member);
    return member;
  }
}
