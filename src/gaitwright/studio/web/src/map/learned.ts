// What the robot has learned of its ground, gathered over the whole run: what is told are the heights around it.

import { effect, signal } from "@preact/signals";
import { floats } from "../bytes";
import type { Seen, Vec2, World } from "../protocol";
import type { Source } from "../source";
import { sameGround } from "../view/same";

/** Cells along a side of a tile. */
export const SIDE = 64;
const APART = 0.05;

export interface Tile {
  /** Place of its first cell, in cells of the world. */
  column: number;
  row: number;
  /** NaN: unknown. */
  heights: Float32Array;
  version: number;
}

export class Learned {
  readonly tiles = new Map<string, Tile>();
  /** Length of a cell [m]; 0 before anything was seen. */
  spacing = 0;
  /** Cells that are known. */
  known = 0;
  obstacles: Vec2[][] = [];
  walls: number[][] = [];
  walked: Vec2[][] = [];
  /** The way that it came. */
  trail: Vec2[] = [];

  clear(): void {
    this.tiles.clear();
    this.spacing = this.known = 0;
    this.obstacles = [];
    this.walls = [];
    this.walked = [];
    this.trail = [];
  }

  add(seen: Seen): void {
    if (seen.spacing !== this.spacing && Math.abs(seen.spacing - this.spacing) > 1e-9) {
      this.tiles.clear();
      this.known = 0;
      this.spacing = seen.spacing;
    }
    this.obstacles = seen.obstacles;
    this.walls = seen.walls ?? [];
    this.walked = seen.walked ?? [];
    const heights = floats(seen.heights);
    const [first, lowest] = [Math.round(seen.x / this.spacing), Math.round(seen.y / this.spacing)];
    for (let k = 0; k < heights.length; k++) {
      if (Number.isNaN(heights[k])) continue;
      const column = k % seen.columns;
      this.set(first + column, lowest + (k - column) / seen.columns, heights[k]);
    }
  }

  /** The robot was there. */
  at(x: number, y: number): void {
    const last = this.trail.at(-1);
    if (!last || Math.hypot(x - last[0], y - last[1]) > APART) this.trail.push([x, y]);
  }

  private set(column: number, row: number, height: number): void {
    const [tx, ty] = [Math.floor(column / SIDE), Math.floor(row / SIDE)];
    const key = `${tx} ${ty}`;
    let tile = this.tiles.get(key);
    if (!tile) {
      tile = { column: tx * SIDE, row: ty * SIDE, heights: new Float32Array(SIDE * SIDE).fill(NaN), version: 0 };
      this.tiles.set(key, tile);
    }
    const at = (row - tile.row) * SIDE + (column - tile.column);
    if (tile.heights[at] === height) return;
    if (Number.isNaN(tile.heights[at])) this.known += 1;
    tile.heights[at] = height;
    tile.version += 1;
  }
}

export const learned = new Learned();
/** Changes whenever there is more to draw. */
export const news = signal(0);

/** Gathers what a source tells. A run begins with a `hello`; who comes later is then told what was seen before.
    A page that was cut off and comes back keeps what it has, unless it finds another run. */
export function gather(source: Source): () => void {
  let wasCut = false;
  let time = -Infinity;
  let world: World | null = null;
  const anew = () => {
    learned.clear();
    news.value = news.peek() + 1;
  };
  const stops = [
    effect(() => {
      if (source.link.value === "lost") wasCut = true;
    }),
    effect(() => {
      void source.hello.value;
      if (!wasCut) anew();
      wasCut = false;
    }),
    effect(() => {
      const now = source.world.value;
      if (now && !sameGround(now, world)) anew();
      world = now;
    }),
    effect(() => {
      const now = source.status.value?.time ?? time;
      if (now < time) anew();
      time = now;
    }),
    effect(() => {
      const seen = source.seen.value;
      if (!seen) return;
      learned.add(seen);
      const row = source.latest(0);
      const at = source.layout.peek()?.at("position_w");
      if (row && at !== undefined) learned.at(row[at], row[at + 1]);
      news.value = news.peek() + 1;
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}
