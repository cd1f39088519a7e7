// Pictures as fine as this machine draws them fast enough: coarser where it is slow, never finer again.

import type { WebGLRenderer } from "three";

const SLOW = 70;
const PICTURES = 12;

export class Quality {
  private level = 0;
  private times: number[] = [];
  private before = 0;

  /** `plain`: draws no shadows any more. */
  constructor(private readonly renderer: WebGLRenderer, private readonly plain: () => void) {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  }

  /** A picture at a time of the page's clock [ms]. */
  drawn(now: number): void {
    const took = now - this.before;
    this.before = now;
    if (document.hidden || this.level === 2) return;
    this.times.push(took);
    if (this.times.length < PICTURES) return;
    const middle = this.times.sort((a, b) => a - b)[PICTURES >> 1];
    this.times = [];
    if (middle < SLOW) return;
    this.level += 1;
    if (this.level === 1) this.renderer.setPixelRatio(Math.min(devicePixelRatio, 1) * 0.75);
    else this.plain();
  }
}
