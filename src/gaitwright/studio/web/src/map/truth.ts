// The true ground, from above: its relief, and outlines of all that stands on it.

import { floats, integers } from "../bytes";
import type { Box, Mesh, Moved, Vec2, World } from "../protocol";
import type { Theme } from "../shell/theme";
import { Heights } from "../view/heights";
import { hull } from "../view/hull";
import { type Range, relief } from "./relief";

const LEAST_RANGE = 0.25;
const MOST_CELLS = 300;

export interface Ground {
  picture: HTMLCanvasElement;
  /** Where the picture lies: x0, y0, x1, y1 [m]. */
  place: [number, number, number, number];
}

export interface Outline {
  points: Vec2[];
  /** Whether it can move, or be moved. */
  loose: boolean;
}

/** Knows one world at a time. */
export class Truth {
  private world: World | null = null;
  private heights: Heights | null = null;
  private pictures = new Map<Theme, Ground>();
  private hulls: Vec2[][] = [];
  range: Range = { low: -LEAST_RANGE, level: 0, high: LEAST_RANGE };

  know(world: World): void {
    if (world === this.world) return;
    if (world.ground !== this.world?.ground) {
      this.heights = new Heights(floats(world.ground.points), integers(world.ground.indices));
      this.pictures.clear();
      this.hulls = world.meshes.map((mesh) => hull(fromAbove(mesh)));
      this.range = rangeOf(this.heights);
    }
    this.world = world;
  }

  ground(theme: Theme): Ground | null {
    const { world, heights } = this;
    if (!world || !heights) return null;
    const known = this.pictures.get(theme);
    if (known) return known;
    const [x0, y0, x1, y1] = world.bounds;
    const spacing = Math.max(0.03, Math.max(x1 - x0, y1 - y0) / MOST_CELLS);
    const [columns, rows] = [Math.max(1, Math.round((x1 - x0) / spacing)), Math.max(1, Math.round((y1 - y0) / spacing))];
    const grid = new Float32Array(columns * rows);
    for (let k = 0; k < grid.length; k++) {
      const column = k % columns;
      grid[k] = heights.at(x0 + (column + 0.5) * spacing, y0 + ((k - column) / columns + 0.5) * spacing);
    }
    const picture = relief(grid, columns, spacing, this.range, theme);
    const made: Ground = { picture, place: [x0, y0, x0 + columns * spacing, y0 + rows * spacing] };
    this.pictures.set(theme, made);
    return made;
  }

  /** `boxes`: where they are now. */
  outlines(boxes: readonly Box[], moved: Moved | null): Outline[] {
    const world = this.world;
    if (!world) return [];
    const loose = [...boxes, ...(moved?.things ?? [])].map((box) => ({ points: corners(box), loose: true }));
    const spheres = world.spheres.map(({ x, y, radius }) => ({ points: circle(x, y, radius), loose: false }));
    return [...loose, ...spheres, ...this.hulls.map((points) => ({ points, loose: false }))];
  }
}

function rangeOf({ low, high }: Heights): Range {
  const level = low < -0.02 && high < 0.02 ? high : Math.max(low, Math.min(0, high));
  return { low: Math.min(low, level - LEAST_RANGE), level, high: Math.max(high, level + LEAST_RANGE) };
}

function fromAbove(mesh: Mesh): Vec2[] {
  const points = floats(mesh.points);
  return Array.from({ length: points.length / 3 }, (_, k) => [points[3 * k], points[3 * k + 1]]);
}

function corners({ x, y, yaw, lx, ly }: Pick<Box, "x" | "y" | "yaw" | "lx" | "ly">): Vec2[] {
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => {
    const [dx, dy] = [(a * lx) / 2, (b * ly) / 2];
    return [x + c * dx - s * dy, y + s * dx + c * dy];
  });
}

function circle(x: number, y: number, radius: number): Vec2[] {
  return Array.from({ length: 20 }, (_, k) => {
    const turn = (k * Math.PI) / 10;
    return [x + radius * Math.cos(turn), y + radius * Math.sin(turn)];
  });
}
