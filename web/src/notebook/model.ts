// The model of a widget: values that Python and the picture share. `python/teeter/notebook/view.py`
// declares them.

export interface Values {
  /** Edge lengths of the blocks, m: three 32-bit floats a block. */
  sizes: DataView;
  /** Poses of one or more states, seven 32-bit floats a block: position, m, and orientation. */
  poses: DataView;
  /** Simulated time from one state to the next, s. */
  interval: number;
  /** State in the picture; a fraction is between two states. */
  frame: number;
  playing: boolean;
  /** X-ray: load and breakaway force of each block, N; empty without one. */
  readings: DataView;
  /** Block that was clicked, -1 for none. */
  selected: number;
  /** Height of the picture, px. */
  height: number;
}

export interface Model {
  get<K extends keyof Values>(name: K): Values[K];
  set<K extends keyof Values>(name: K, value: Values[K]): void;
  save_changes(): void;
  on(event: string, callback: () => void): void;
  off(event: string, callback: () => void): void;
}

/** Returns the numbers of a buffer, which may begin at any byte. */
export function floats({ buffer, byteOffset, byteLength }: DataView): Float32Array {
  return new Float32Array(buffer.slice(byteOffset, byteOffset + byteLength) as ArrayBuffer);
}

/** Calls back when one of some values changes; returns a function that ends it. */
export function follow(model: Model, names: readonly (keyof Values)[], callback: () => void): () => void {
  for (const name of names) model.on(`change:${name}`, callback);
  return () => names.forEach(name => model.off(`change:${name}`, callback));
}
