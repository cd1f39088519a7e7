// A line on the ground with a width in metres: a strip of triangles.

import {
  BufferAttribute, BufferGeometry, type ColorRepresentation, DoubleSide, GreaterDepth, Mesh, MeshBasicMaterial,
} from "three";

type Line = readonly (readonly number[])[];

export class Ribbon {
  readonly mesh: Mesh<BufferGeometry, MeshBasicMaterial>;
  /** Wider for larger robots. */
  scale = 1;
  /** What of it is behind something, faint. */
  private readonly behind: Mesh<BufferGeometry, MeshBasicMaterial> | null = null;

  /** `through`: whether it is seen through what is before it. */
  constructor(colour: ColorRepresentation, private readonly wide: number, opacity = 1, through = false) {
    const material = new MeshBasicMaterial({
      color: colour, side: DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1,
      polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2, toneMapped: false,
    });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    if (!through) return;
    const faint = material.clone();
    Object.assign(faint, { transparent: true, opacity: 0.3 * opacity, depthWrite: false, depthFunc: GreaterDepth });
    this.behind = new Mesh(this.mesh.geometry, faint);
    this.behind.frustumCulled = false;
    this.mesh.add(this.behind);
  }

  set(points: Line, closed = false): void {
    this.setAll([closed ? close(points) : points]);
  }

  /** Several lines, drawn as one. */
  setAll(lines: readonly Line[]): void {
    const at: number[] = [];
    for (const line of lines) this.lay(line, at);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute("position", new BufferAttribute(new Float32Array(at), 3));
    if (this.behind) this.behind.geometry = this.mesh.geometry;
    this.mesh.visible = at.length > 0;
  }

  private lay(line: Line, at: number[]): void {
    for (let k = 0; k + 1 < line.length; k++) {
      const [a, b] = [line[k], line[k + 1]];
      const long = Math.hypot(b[0] - a[0], b[1] - a[1]);
      if (long < 1e-6) continue;
      const half = (this.scale * this.wide) / 2;
      const [ux, uy] = [((b[0] - a[0]) / long) * half, ((b[1] - a[1]) / long) * half];
      // each piece a little longer than it is, so that corners close
      const corners = [
        [a[0] - ux - uy, a[1] - uy + ux, a[2]], [a[0] - ux + uy, a[1] - uy - ux, a[2]],
        [b[0] + ux + uy, b[1] + uy - ux, b[2]], [b[0] + ux - uy, b[1] + uy + ux, b[2]],
      ];
      for (const corner of [0, 1, 2, 0, 2, 3]) at.push(...corners[corner]);
    }
  }
}

/** A line that ends where it begins. */
export function close(points: Line): Line {
  return points.length > 2 ? [...points, points[0]] : points;
}
