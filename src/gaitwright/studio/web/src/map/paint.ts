// Draws a map: what the robot has learned, or what is there.

import type { Status, Vec2 } from "../protocol";
import { colour, type Theme } from "../shell/theme";
import type { Source } from "../source";
import { watched } from "../view/settings";
import { learned, SIDE, type Tile } from "./learned";
import { type Range, relief } from "./relief";
import { type Frame, scale, toScreen } from "./sight";
import type { Truth } from "./truth";

export type What = "learned" | "true";

const pictures = new WeakMap<Tile, { version: number; look: string; picture: HTMLCanvasElement }>();

export interface Painting {
  context: CanvasRenderingContext2D;
  frame: Frame;
  source: Source;
  truth: Truth;
  theme: Theme;
}

export function paint(what: What, painting: Painting): void {
  const { context, frame, source, truth } = painting;
  context.clearRect(0, 0, frame.width, frame.height);
  context.fillStyle = colour("--back");
  context.fillRect(0, 0, frame.width, frame.height);
  context.imageSmoothingEnabled = false;
  if (what === "true") {
    const ground = truth.ground(painting.theme);
    if (ground) lay(painting, ground.picture, ground.place);
    for (const { points, loose } of truth.outlines(source.boxes.peek(), source.moved.peek())) {
      context.fillStyle = `color-mix(in srgb, ${colour(loose ? "--warn" : "--ink")} 26%, transparent)`;
      context.fill(shape(frame, points, true));
      stroke(painting, points, "--faint", 1, true);
    }
  } else {
    for (const tile of learned.tiles.values()) layTile(painting, tile, truth.range);
    for (const { points } of truth.outlines(source.boxes.peek(), source.moved.peek())) stroke(painting, points, "--faint", 0.7, true, [3, 2]);
    for (const way of learned.walked) stroke(painting, way, "--accent", 1.5);
    for (const outline of learned.obstacles) stroke(painting, outline, "--bad", 1.5, true);
    for (const [x0, y0, x1, y1] of learned.walls) stroke(painting, [[x0, y0], [x1, y1]], "--bad", 2);
  }
  field(painting);
  way(painting);
  robots(painting);
  ruler(painting);
}

/** A picture on its place of the world. */
function lay({ context, frame }: Painting, picture: HTMLCanvasElement, [x0, y0, x1, y1]: number[]): void {
  // whole pixels, so that no seam shows between neighbours
  const [left, top] = toScreen(frame, x0, y1).map(Math.round);
  const [right, bottom] = toScreen(frame, x1, y0).map(Math.round);
  if (right < 0 || bottom < 0 || left > frame.width || top > frame.height) return;
  context.drawImage(picture, left, top, right - left, bottom - top);
}

function layTile(painting: Painting, tile: Tile, range: Range): void {
  const look = `${painting.theme} ${range.low} ${range.high}`;
  let kept = pictures.get(tile);
  if (kept?.version !== tile.version || kept.look !== look) {
    const picture = relief(tile.heights, SIDE, learned.spacing, range, painting.theme);
    kept = { version: tile.version, look, picture };
    pictures.set(tile, kept);
  }
  const [x0, y0] = [(tile.column - 0.5) * learned.spacing, (tile.row - 0.5) * learned.spacing];
  const long = SIDE * learned.spacing;
  lay(painting, kept.picture, [x0, y0, x0 + long, y0 + long]);
}

function shape(frame: Frame, points: readonly Vec2[], closed: boolean): Path2D {
  const path = new Path2D();
  for (const [x, y] of points) path.lineTo(...toScreen(frame, x, y));
  if (closed) path.closePath();
  return path;
}

function stroke(
  { context, frame }: Painting, points: readonly Vec2[], variable: string, width: number, closed = false, dashes: number[] = [],
): void {
  context.strokeStyle = colour(variable);
  context.lineWidth = width;
  context.setLineDash(dashes);
  context.stroke(shape(frame, points, closed));
  context.setLineDash([]);
}

/** The edge of the field. */
function field(painting: Painting): void {
  const bounds = painting.source.world.peek()?.bounds;
  if (!bounds) return;
  const [x0, y0, x1, y1] = bounds;
  stroke(painting, [[x0, y0], [x1, y0], [x1, y1], [x0, y1]], "--line-strong", 1, true);
}

/** The way that it came and the one that it goes. */
function way(painting: Painting): void {
  const { context, frame, source } = painting;
  stroke(painting, learned.trail, "--ink", 1.2);
  const status: Status | null = source.status.peek();
  if (!status) return;
  if (status.route.length) stroke(painting, status.route, "--good", 2, false, [6, 3]);
  if (status.goal) {
    const [x, y] = toScreen(frame, ...status.goal);
    context.strokeStyle = colour("--good");
    context.lineWidth = 2;
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.stroke();
  }
}

/** Each robot by its length and width, with its head. */
function robots({ context, frame, source }: Painting): void {
  const layout = source.layout.peek();
  const world = source.world.peek();
  if (!layout || !world) return;
  world.robots.forEach((robot, k) => {
    const row = source.latest(k);
    if (!row) return;
    const [x, y] = layout.get(row, "position_w");
    const [w, qx, qy, z] = layout.get(row, "orientation_wb");
    const yaw = Math.atan2(2 * (w * z + qx * qy), 1 - 2 * (qy * qy + z * z));
    const reach = Math.max(...robot.hip.map((hip) => Math.abs(hip[0])), 0.1);
    const wide = Math.max(...robot.hip.map((hip) => Math.abs(hip[1])), 0.08);
    const size = Math.max(1, 8 / (reach * scale.peek()));
    context.save();
    context.translate(...toScreen(frame, x, y));
    context.rotate(-yaw);
    context.scale(scale.peek() * size, scale.peek() * size);
    context.beginPath();
    context.moveTo(-1.15 * reach, -1.5 * wide);
    context.lineTo(0.9 * reach, -1.5 * wide);
    context.lineTo(1.5 * reach, 0);
    context.lineTo(0.9 * reach, 1.5 * wide);
    context.lineTo(-1.15 * reach, 1.5 * wide);
    context.closePath();
    context.restore();
    context.fillStyle = colour(k === watched.peek() ? "--accent" : "--faint");
    context.fill();
    context.strokeStyle = colour("--face");
    context.lineWidth = 1.5;
    context.stroke();
  });
}

/** A length of so many metres. */
function ruler({ context, frame }: Painting): void {
  const long = [0.2, 0.5, 1, 2, 5, 10, 20, 50].find((one) => one * scale.peek() >= 50) ?? 100;
  const [x, y] = [10, frame.height - 10];
  context.strokeStyle = context.fillStyle = colour("--ink");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y - 4);
  context.lineTo(x, y);
  context.lineTo(x + long * scale.peek(), y);
  context.lineTo(x + long * scale.peek(), y - 4);
  context.stroke();
  context.font = `10.5px ${colour("--font")}`;
  context.fillText(`${long} m`, x + 4, y - 5);
}
