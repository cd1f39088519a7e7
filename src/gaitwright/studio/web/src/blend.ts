// A row between two rows: numbers linearly, quaternions along the shorter arc, switches from the nearer one.

import type { Layout } from "./layout";

const TURNS = ["orientation_wb", "reference_orientation_wb"];
const SWITCHES = ["stance", "driver", "footholds_w"];

export class Blend {
  private readonly turns: number[];
  private readonly switches: [number, number][];

  constructor(private readonly layout: Layout) {
    this.turns = TURNS.filter((name) => layout.has(name)).map((name) => layout.at(name));
    this.switches = SWITCHES.filter((name) => layout.has(name)).map((name) => [
      layout.at(name),
      layout.size(name),
    ]);
  }

  /** `share` 0: before, 1: after. */
  into(out: Float32Array, before: Float32Array, after: Float32Array, share: number): void {
    for (let k = 0; k < this.layout.width; k++) out[k] = before[k] + share * (after[k] - before[k]);
    for (const at of this.turns) blendTurn(out, before, after, share, at);
    const nearer = share < 0.5 ? before : after;
    for (const [at, size] of this.switches) for (let k = at; k < at + size; k++) out[k] = nearer[k];
    // a phase wraps: never run backwards through it
    if (this.layout.has("phase")) {
      const at = this.layout.at("phase");
      if (Math.abs(after[at] - before[at]) > 0.5) out[at] = nearer[at];
    }
  }
}

function blendTurn(out: Float32Array, a: Float32Array, b: Float32Array, share: number, at: number): void {
  let dot = 0;
  for (let k = 0; k < 4; k++) dot += a[at + k] * b[at + k];
  const side = dot < 0 ? -1 : 1;
  let norm = 0;
  for (let k = 0; k < 4; k++) {
    out[at + k] = (1 - share) * a[at + k] + share * side * b[at + k];
    norm += out[at + k] ** 2;
  }
  norm = Math.sqrt(norm) || 1;
  for (let k = 0; k < 4; k++) out[at + k] /= norm;
}
