// The state of a page: its only source of truth. Parts of the page subscribe to the fields they
// show.

export class Store<S extends object> {
  private readonly listeners = new Map<keyof S, Set<() => void>>();

  constructor(private current: Readonly<S>) {}

  get state(): Readonly<S> {
    return this.current;
  }

  /** Changes fields and notifies, once each, the listeners of those that differ. */
  set(change: Partial<S>): void {
    const keys = (Object.keys(change) as (keyof S)[]).filter(key => !Object.is(change[key], this.current[key]));
    if (keys.length === 0) return;
    this.current = { ...this.current, ...change };
    const due = new Set(keys.flatMap(key => [...(this.listeners.get(key) ?? [])]));
    for (const listener of due) listener();
  }

  /** Calls `listener` after a change of any of the fields, and once now. */
  subscribe(keys: readonly (keyof S)[], listener: (state: Readonly<S>) => void): void {
    const notify = () => listener(this.current);
    for (const key of keys) {
      if (!this.listeners.has(key)) this.listeners.set(key, new Set());
      this.listeners.get(key)!.add(notify);
    }
    notify();
  }
}
