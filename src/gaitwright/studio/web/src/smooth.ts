// Frames at the display's rate: a short buffer, played a little late, blended between the frames around.

import { Blend } from "./blend";
import type { Frame } from "./frame";
import type { Layout } from "./layout";

const KEPT = 12;
const LEAST_DELAY = 0.015;
const MOST_DELAY = 0.12;

export class Smooth {
  private readonly frames: Frame[] = [];
  private readonly blend: Blend;
  /** Page's clock minus server's clock [s]: the least seen, so that it has no jitter. */
  private offset = Infinity;
  private spacing = 1 / 30;

  constructor(layout: Layout, private readonly timeAt: number) {
    this.blend = new Blend(layout);
  }

  /** A frame that came at `now` [s of the page's clock]. */
  add(frame: Frame, now: number): void {
    const last = this.frames.at(-1);
    if (last) {
      const anew =
        last.rows.length !== frame.rows.length ||
        (frame.rows.length > 0 && frame.rows[0][this.timeAt] < last.rows[0][this.timeAt]);
      if (anew || frame.sent <= last.sent) this.frames.length = 0;
      else this.spacing += 0.1 * (Math.min(frame.sent - last.sent, 0.2) - this.spacing);
    }
    const offset = now - frame.sent;
    // clocks drift, and a pause of the network ends: follow slowly upwards, at once downwards
    this.offset = offset < this.offset || offset > this.offset + 2 ? offset : this.offset + 0.002 * (offset - this.offset);
    this.frames.push(frame);
    if (this.frames.length > KEPT) this.frames.shift();
  }

  get newest(): Frame | null {
    return this.frames.at(-1) ?? null;
  }

  clear(): void {
    this.frames.length = 0;
    this.offset = Infinity;
  }

  sample(robot: number, now: number, out: Float32Array): boolean {
    const newest = this.newest;
    if (!newest || robot >= newest.rows.length) return false;
    const delay = Math.min(MOST_DELAY, Math.max(LEAST_DELAY, 1.5 * this.spacing));
    const at = now - this.offset - delay;
    let k = this.frames.length - 1;
    while (k > 0 && this.frames[k].sent > at) k--;
    const before = this.frames[k];
    const after = this.frames[Math.min(k + 1, this.frames.length - 1)];
    const span = after.sent - before.sent;
    const share = span > 0 ? Math.min(1, Math.max(0, (at - before.sent) / span)) : 0;
    this.blend.into(out, before.rows[robot], after.rows[robot], share);
    return true;
  }
}
