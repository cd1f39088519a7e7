// Height of the ground at a place, and where a ray meets it: the mesh, laid on a grid once.

const MOST_CELLS = 400;

export class Heights {
  readonly columns: number;
  readonly rows: number;
  private readonly spacing: number;
  private readonly x0: number;
  private readonly y0: number;
  private readonly grid: Float32Array;
  low = Infinity;
  high = -Infinity;

  constructor(points: Float32Array, indices: Uint32Array) {
    let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let k = 0; k < points.length; k += 3) {
      x0 = Math.min(x0, points[k]);
      x1 = Math.max(x1, points[k]);
      y0 = Math.min(y0, points[k + 1]);
      y1 = Math.max(y1, points[k + 1]);
      this.low = Math.min(this.low, points[k + 2]);
      this.high = Math.max(this.high, points[k + 2]);
    }
    this.x0 = x0;
    this.y0 = y0;
    this.spacing = Math.max(0.025, Math.max(x1 - x0, y1 - y0) / MOST_CELLS);
    this.columns = Math.max(1, Math.ceil((x1 - x0) / this.spacing) + 1);
    this.rows = Math.max(1, Math.ceil((y1 - y0) / this.spacing) + 1);
    this.grid = new Float32Array(this.columns * this.rows).fill(NaN);
    for (let k = 0; k < indices.length; k += 3) {
      this.lay(points, 3 * indices[k], 3 * indices[k + 1], 3 * indices[k + 2]);
    }
  }

  /** NaN off the mesh. */
  at(x: number, y: number): number {
    const column = Math.round((x - this.x0) / this.spacing);
    const row = Math.round((y - this.y0) / this.spacing);
    if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return NaN;
    return this.grid[row * this.columns + column];
  }

  /** Distance along a ray (unit direction) to the ground; `null` where it misses. */
  hit(from: Triple, along: Triple): number | null {
    const most = 200;
    let before = 0;
    for (let far = 0; far < most; far += Math.max(this.spacing, 0.004 * far)) {
      const [x, y, z] = [0, 1, 2].map((k) => from[k] + far * along[k]);
      const ground = this.at(x, y);
      if (z <= ground) return this.refine(from, along, before, far);
      if (z < this.low - 0.01 && along[2] <= 0) return null; // beside the mesh
      before = far;
    }
    return null;
  }

  private refine(from: Triple, along: Triple, above: number, below: number): number {
    let [low, high] = [above, below];
    for (let k = 0; k < 16; k++) {
      const far = (low + high) / 2;
      const ground = this.at(from[0] + far * along[0], from[1] + far * along[1]);
      if (from[2] + far * along[2] <= ground) high = far;
      else low = far;
    }
    return high;
  }

  private lay(points: Float32Array, a: number, b: number, c: number): void {
    const [ax, ay, az] = [points[a], points[a + 1], points[a + 2]];
    const [bx, by, bz] = [points[b], points[b + 1], points[b + 2]];
    const [cx, cy, cz] = [points[c], points[c + 1], points[c + 2]];
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (Math.abs(area) < 1e-12) return;
    const s = this.spacing;
    const first = Math.max(0, Math.ceil((Math.min(ax, bx, cx) - this.x0) / s - 1e-6));
    const last = Math.min(this.columns - 1, Math.floor((Math.max(ax, bx, cx) - this.x0) / s + 1e-6));
    const lowest = Math.max(0, Math.ceil((Math.min(ay, by, cy) - this.y0) / s - 1e-6));
    const highest = Math.min(this.rows - 1, Math.floor((Math.max(ay, by, cy) - this.y0) / s + 1e-6));
    for (let row = lowest; row <= highest; row++) {
      const y = this.y0 + row * s;
      for (let column = first; column <= last; column++) {
        const x = this.x0 + column * s;
        const v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area;
        const w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area;
        if (v < -1e-6 || w < -1e-6 || v + w > 1 + 1e-6) continue;
        const at = row * this.columns + column;
        const z = az + v * (bz - az) + w * (cz - az);
        if (!(this.grid[at] >= z)) this.grid[at] = z;
      }
    }
  }
}

type Triple = readonly [number, number, number];
