// Where the columns of a frame's row are.

import type { Column } from "./protocol";

export class Layout {
  readonly width: number;
  private readonly places = new Map<string, { at: number; size: number }>();

  constructor(readonly columns: readonly Column[]) {
    let at = 0;
    for (const { name, size } of columns) {
      this.places.set(name, { at, size });
      at += size;
    }
    this.width = at;
  }

  has(name: string): boolean {
    return this.places.has(name);
  }

  /** Place of a column's first number. */
  at(name: string): number {
    const place = this.places.get(name);
    if (!place) throw new Error(`no column ${name}; columns: ${[...this.places.keys()].join(", ")}`);
    return place.at;
  }

  size(name: string): number {
    return this.places.get(name)?.size ?? 0;
  }

  /** A column of a row, as a view. */
  get(row: Float32Array, name: string): Float32Array {
    const at = this.at(name);
    return row.subarray(at, at + this.size(name));
  }
}
