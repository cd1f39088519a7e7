// Rows for all plots, gathered once per refresh.

import type { Source } from "../source";
import { watched } from "../view/settings";
import { span } from "./span";

const EVERY = 1000 / 15;
const MOST = 1500;

type Take = (times: number[], rows: Float32Array[], span: [number, number]) => void;

export class Feed {
  private readonly takers = new Set<Take>();
  private running = 0;
  private before = 0;
  private shown = "";

  constructor(readonly source: Source) {}

  add(take: Take): () => void {
    this.takers.add(take);
    this.shown = "";
    if (!this.running) this.run(performance.now());
    return () => {
      this.takers.delete(take);
      if (!this.takers.size) {
        cancelAnimationFrame(this.running);
        this.running = 0;
      }
    };
  }

  /** Draws again even if nothing came. */
  refresh(): void {
    this.shown = "";
  }

  /** Time of what the views show [s]. */
  now(): number {
    return this.source.now();
  }

  private readonly run = (at: number): void => {
    this.running = requestAnimationFrame(this.run);
    if (at - this.before < EVERY) return;
    this.before = at;
    const history = this.source.history(watched.peek());
    if (!history || !history.count) return;
    const [from, to] = span(this.source.now(), this.source.kind === "replay", history.last());
    const shown = `${history.version} ${from} ${to} ${this.source.kind === "replay" ? this.now() : ""}`;
    if (shown === this.shown) return;
    this.shown = shown;
    const first = Math.max(0, history.from(from) - 1);
    const last = Math.min(history.count - 1, history.from(to));
    const stride = Math.max(1, Math.ceil((last - first) / MOST));
    const times: number[] = [];
    const rows: Float32Array[] = [];
    for (let k = first; k <= last; k += stride) {
      times.push(history.time(k));
      rows.push(history.row(k));
    }
    for (const take of this.takers) take(times, rows, [from, to]);
  };
}
