// The last stretch of one robot's rows, for plots: a ring of rows in order of time.

const CAPACITY = 7200; // 60 s at 120 frames a second

export class History {
  private readonly rows: Float32Array;
  private first = 0;
  /** Number of rows held. */
  count = 0;
  /** Counts all changes; plots redraw when it differs. */
  version = 0;

  constructor(
    readonly width: number,
    readonly timeAt: number,
    readonly seconds = 60,
    readonly capacity = CAPACITY,
  ) {
    this.rows = new Float32Array(capacity * width);
  }

  /** Adds a row; a time before the last one starts anew, the same time is ignored. */
  add(row: Float32Array): void {
    const time = row[this.timeAt];
    const last = this.last();
    if (last === time) return;
    if (last > time) this.clear();
    if (this.count === this.capacity) this.drop();
    this.rows.set(row, ((this.first + this.count) % this.capacity) * this.width);
    this.count += 1;
    this.version += 1;
    while (this.count > 1 && this.time(0) < time - this.seconds) this.drop();
  }

  clear(): void {
    this.first = 0;
    this.count = 0;
    this.version += 1;
  }

  /** The k-th row from the oldest on, as a view. */
  row(k: number): Float32Array {
    const at = ((this.first + k) % this.capacity) * this.width;
    return this.rows.subarray(at, at + this.width);
  }

  time(k: number): number {
    return this.rows[((this.first + k) % this.capacity) * this.width + this.timeAt];
  }

  /** Time of the newest row; −∞ where there is none. */
  last(): number {
    return this.count ? this.time(this.count - 1) : -Infinity;
  }

  /** Index of the first row not before a time. */
  from(time: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const mid = (low + high) >> 1;
      if (this.time(mid) < time) low = mid + 1;
      else high = mid;
    }
    return low;
  }

  private drop(): void {
    this.first = (this.first + 1) % this.capacity;
    this.count -= 1;
  }
}
