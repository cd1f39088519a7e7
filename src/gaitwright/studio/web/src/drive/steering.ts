// A velocity that is held by keys, a stick or a game-pad: sent twenty times a second, zero when it is let go.

import { effect, signal } from "@preact/signals";
import { drives, type Source } from "../source";
import { remembered } from "../ui/remembered";

export interface Velocity {
  forward: number;
  left: number;
  turn: number;
}

const EVERY = 50;

/** Velocities at full deflection [m/s, m/s, rad/s]. */
export const full = {
  forward: remembered("full.forward", 0.5),
  left: remembered("full.left", 0.2),
  turn: remembered("full.turn", 0.6),
};

/** What is held now, as shares of full deflection, for the panel. */
export const held = signal<Velocity | null>(null);

export type Hand = "keys" | "stick" | "pad";

export class Steering {
  private readonly hands = new Map<Hand, Velocity>();
  private timer = 0;

  constructor(private readonly source: Source) {
    // who loses the wheel has let go: what is held from then on is nobody's business
    effect(() => {
      if (!drives(source)) this.release();
    });
  }

  /** Shares of full deflection, −1 … 1; `null` lets go. */
  hold(hand: Hand, share: Velocity | null): void {
    if (share && !drives(this.source)) return;
    const before = this.hands.size;
    if (share) this.hands.set(hand, share);
    else this.hands.delete(hand);
    if (this.hands.size && !this.timer) {
      this.timer = window.setInterval(() => this.send(), EVERY);
      this.send();
    }
    if (before && !this.hands.size) this.letGo();
    held.value = this.hands.size ? this.sum() : null;
  }

  /** Lets go with all hands. */
  release(): void {
    if (!this.hands.size) return;
    this.hands.clear();
    held.value = null;
    this.letGo();
  }

  private letGo(): void {
    clearInterval(this.timer);
    this.timer = 0;
    if (drives(this.source)) this.source.tell({ do: "steer", forward: 0, left: 0, turn: 0 });
  }

  private sum(): Velocity {
    const sum = { forward: 0, left: 0, turn: 0 };
    for (const one of this.hands.values()) {
      sum.forward += one.forward;
      sum.left += one.left;
      sum.turn += one.turn;
    }
    const bound = (value: number) => Math.max(-1, Math.min(1, value));
    return { forward: bound(sum.forward), left: bound(sum.left), turn: bound(sum.turn) };
  }

  private send(): void {
    const { forward, left, turn } = this.sum();
    this.source.tell({
      do: "steer",
      forward: forward * full.forward.peek(),
      left: left * full.left.peek(),
      turn: turn * full.turn.peek(),
    });
  }
}
