// The time that is shown: one for all recordings on the page.

import { computed, signal } from "@preact/signals";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

class Clock {
  readonly time = signal(0);
  readonly playing = signal(false);
  readonly speed = signal(1);
  readonly duration = signal(0);
  readonly atEnd = computed(() => this.time.value >= this.duration.value);
  private before = 0;

  /** Goes on with every picture of the display, also where there are no views, until it is stopped. */
  run(): () => void {
    let running = 0;
    const next = (now: number) => {
      running = requestAnimationFrame(next);
      this.advance(now);
    };
    running = requestAnimationFrame(next);
    return () => cancelAnimationFrame(running);
  }

  /** Goes on to a time of the page's clock [ms]. */
  advance(now: number): void {
    const passed = Math.min(0.25, Math.max(0, (now - this.before) / 1000));
    this.before = now;
    if (!this.playing.peek()) return;
    this.seek(this.time.peek() + passed * this.speed.peek());
    if (this.time.peek() >= this.duration.peek()) this.playing.value = false;
  }

  /** What is shown lasts so long [s]. */
  lasts(duration: number): void {
    this.duration.value = duration;
    this.seek(this.time.peek());
  }

  seek(time: number): void {
    this.time.value = Math.max(0, Math.min(this.duration.peek(), time));
  }

  play(): void {
    if (this.atEnd.peek()) this.seek(0);
    this.playing.value = true;
  }

  toggle(): void {
    if (this.playing.peek()) this.playing.value = false;
    else this.play();
  }
}

export const clock = new Clock();
export type { Clock };
