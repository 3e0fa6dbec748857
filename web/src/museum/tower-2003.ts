// A game with the 2003 tower in wasm memory. It has no clock and no messages.

import { POSE_STRIDE, type Contact, type GameCommand, type Update } from '../engine/game-protocol';
import { LATTICE_STRIDE } from '../view/lattice';
import { SpaceGame } from '../wasm/teeter_museum.js';
import type { ConstantEntry, ConstantValues, Report2003, Request2003 } from './protocol';

export class Game2003 {
  private readonly game: SpaceGame;

  /** Throws an Error whose message is for the user. */
  constructor(
    scene: string,
    constants: ConstantValues,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.game = new SpaceGame(scene, JSON.stringify(constants));
  }

  /** Constants that can be set. */
  static constants(): ConstantEntry[] {
    return JSON.parse(SpaceGame.constants()) as ConstantEntry[];
  }

  free(): void {
    this.game.free();
  }

  /** Edge lengths, three numbers per body, m; a copy that may be transferred. */
  sizes(): Float32Array {
    return this.game.sizes();
  }

  /** Poses, seven numbers per body; a copy that may be transferred. */
  poses(): Float32Array {
    const { length } = this.game;
    // Memory may have grown since the last view, so each one is new.
    return Float32Array.from(new Float64Array(this.memory.buffer, this.game.posesPtr(), length * POSE_STRIDE));
  }

  /** Particles and springs, a copy that may be transferred. */
  lattices(): Float32Array {
    const { length } = this.game;
    // The pointer comes first: writing the particles may let memory grow.
    const pointer = this.game.latticesPtr();
    return new Float32Array(this.memory.buffer, pointer, length * LATTICE_STRIDE).slice();
  }

  contacts(body: number): Contact[] {
    return JSON.parse(this.game.contacts(body)) as Contact[];
  }

  /** Returns true if the command to place the body would be carried out. */
  canPlace(body: number): boolean {
    return body < this.game.length && this.game.canPlace(body);
  }

  /** Takes a request to the hand of 2003 for the next step. */
  request(request: Request2003): void {
    this.game.request(JSON.stringify(request));
  }

  /** Takes constants for the next step. Throws an Error where they are not accepted. */
  setConstants(values: ConstantValues): void {
    this.game.setConstants(JSON.stringify(values));
  }

  /** Carries out a command and steps by a frame. */
  step(command: GameCommand): Update<Report2003> {
    return JSON.parse(this.game.step(JSON.stringify(command))) as Update<Report2003>;
  }
}
