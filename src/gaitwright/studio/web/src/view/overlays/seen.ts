// What the robot knows of the ground: heights as points, walls and obstacles as lines.

import {
  BufferAttribute, BufferGeometry, Color, Group, Points, PointsMaterial,
} from "three";
import { floats } from "../../bytes";
import type { Seen } from "../../protocol";
import { close, Ribbon } from "../ribbon";
import type { Moment, Overlay } from "./overlay";

const LOW = new Color("#2b5f9e");
const MIDDLE = new Color("#2fa37c");
const HIGH = new Color("#f2c037");
const LIFT = 0.012;

export class SeenGround implements Overlay {
  readonly object = new Group();
  private readonly points = new Points(
    new BufferGeometry(),
    new PointsMaterial({ vertexColors: true, sizeAttenuation: true, size: 0.02, toneMapped: false }),
  );
  /** What is in the way, and where it walked: all lines of a kind as one, however many there are. */
  private readonly blocked = new Ribbon("#f03e3e", 0.018, 0.9);
  private readonly walked = new Ribbon("#4263eb", 0.018, 0.9);
  private drawn: Seen | null | undefined;

  constructor() {
    this.points.frustumCulled = false;
    this.object.add(this.points, this.blocked.mesh, this.walked.mesh);
  }

  arrange(): void {
    this.drawn = undefined;
  }

  update({ source, height }: Moment): void {
    const seen = source.seen.peek();
    if (seen === this.drawn) return;
    this.drawn = seen;
    this.points.visible = Boolean(seen);
    if (seen) this.drawHeights(seen);
    const lay = (points: number[][]) => points.map(([x, y]) => [x, y, height(x, y) + 0.02]);
    const obstacles = (seen?.obstacles ?? []).map((outline) => close(lay(outline)));
    const walls = (seen?.walls ?? []).map(([x0, y0, x1, y1]) => lay([[x0, y0], [x1, y1]]));
    this.blocked.setAll([...obstacles, ...walls]);
    this.walked.setAll((seen?.walked ?? []).map(lay));
  }

  private drawHeights(seen: Seen): void {
    const heights = floats(seen.heights);
    let [low, high] = [Infinity, -Infinity];
    for (const z of heights) {
      if (z < low) low = z;
      if (z > high) high = z;
    }
    const span = Math.max(high - low, 0.05);
    const position: number[] = [];
    const colour: number[] = [];
    const mixed = new Color();
    for (let k = 0; k < heights.length; k++) {
      const z = heights[k];
      if (Number.isNaN(z)) continue;
      const column = k % seen.columns;
      position.push(seen.x + column * seen.spacing, seen.y + ((k - column) / seen.columns) * seen.spacing, z + LIFT);
      const share = (z - low) / span;
      if (share < 0.5) mixed.lerpColors(LOW, MIDDLE, 2 * share);
      else mixed.lerpColors(MIDDLE, HIGH, 2 * share - 1);
      colour.push(mixed.r, mixed.g, mixed.b);
    }
    const shape = new BufferGeometry();
    shape.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
    shape.setAttribute("color", new BufferAttribute(new Float32Array(colour), 3));
    this.points.geometry.dispose();
    this.points.geometry = shape;
    this.points.material.size = 0.55 * seen.spacing;
  }
}
