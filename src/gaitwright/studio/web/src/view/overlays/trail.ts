// The way that the robot came.

import type { History } from "../../history";
import { Ribbon } from "../ribbon";
import { watched } from "../settings";
import type { Moment, Overlay } from "./overlay";

const POINTS = 400;
const EVERY = 0.2;

export class Trail implements Overlay {
  private readonly line = new Ribbon("#868e96", 0.012, 0.8);
  readonly object = this.line.mesh;
  private drawn = -1;
  /** Of which run. */
  private of: History | null = null;

  arrange(): void {
    this.of = null;
  }

  update({ source, layout, size, height }: Moment): void {
    const history = source.history(watched.peek());
    const now = source.now();
    if (!history) this.line.set([]);
    if (!history || (history === this.of && Math.abs(now - this.drawn) < EVERY)) return;
    [this.of, this.drawn] = [history, now];
    this.line.scale = size;
    const last = Math.min(history.count - 1, history.from(now));
    const stride = Math.max(1, Math.ceil(last / POINTS));
    const at = layout.at("position_w");
    const points: number[][] = [];
    for (let k = 0; k <= last; k += stride) {
      const row = history.row(k);
      points.push([row[at], row[at + 1], height(row[at], row[at + 1]) + 0.008]);
    }
    this.line.set(points);
  }
}
