// Normals of a mesh that are smooth over gentle slopes and sharp at edges.

export interface Surface {
  position: Float32Array;
  normal: Float32Array;
  index: Uint32Array;
}

/** Points with normals averaged over those faces that bend by less than `bend` [rad]; at an edge a point is there
 * once for each of its sides. */
export function creased(points: Float32Array, indices: Uint32Array, bend = 0.6): Surface {
  const flat = faceNormals(points, indices);
  const { first, list } = facesAt(points.length / 3, indices);
  const out = new Corners(points, indices.length);
  const least = Math.cos(bend);
  for (let corner = 0; corner < indices.length; corner++) {
    const face = 4 * Math.floor(corner / 3);
    const point = indices[corner];
    let [x, y, z] = [0, 0, 0];
    for (let k = first[point]; k < first[point + 1]; k++) {
      const at = 4 * list[k];
      const along = flat[face] * flat[at] + flat[face + 1] * flat[at + 1] + flat[face + 2] * flat[at + 2];
      if (along < least) continue;
      const weight = flat[at + 3];
      x += weight * flat[at];
      y += weight * flat[at + 1];
      z += weight * flat[at + 2];
    }
    const size = Math.hypot(x, y, z) || 1;
    out.add(corner, point, x / size, y / size, z / size);
  }
  return out.surface();
}

/** Corners of faces, those of one point with one normal told once. */
class Corners {
  private readonly index: Uint32Array;
  private readonly normal: number[] = [];
  private readonly from: number[] = [];
  private readonly newest: Int32Array;
  private readonly older: number[] = [];

  constructor(private readonly points: Float32Array, corners: number) {
    this.index = new Uint32Array(corners);
    this.newest = new Int32Array(points.length / 3).fill(-1);
  }

  add(corner: number, point: number, x: number, y: number, z: number): void {
    let at = this.newest[point];
    while (at >= 0 && x * this.normal[3 * at] + y * this.normal[3 * at + 1] + z * this.normal[3 * at + 2] < 0.9999) {
      at = this.older[at];
    }
    if (at < 0) {
      at = this.from.length;
      this.from.push(point);
      this.normal.push(x, y, z);
      this.older.push(this.newest[point]);
      this.newest[point] = at;
    }
    this.index[corner] = at;
  }

  surface(): Surface {
    const position = new Float32Array(3 * this.from.length);
    this.from.forEach((point, k) => {
      for (let axis = 0; axis < 3; axis++) position[3 * k + axis] = this.points[3 * point + axis];
    });
    return { position, normal: new Float32Array(this.normal), index: this.index };
  }
}

/** Unit normal and area of each face. */
function faceNormals(points: Float32Array, indices: Uint32Array): Float32Array {
  const out = new Float32Array((indices.length / 3) * 4);
  for (let face = 0; face < indices.length / 3; face++) {
    const [a, b, c] = [3 * indices[3 * face], 3 * indices[3 * face + 1], 3 * indices[3 * face + 2]];
    const ux = points[b] - points[a];
    const uy = points[b + 1] - points[a + 1];
    const uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a];
    const vy = points[c + 1] - points[a + 1];
    const vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    const size = Math.hypot(x, y, z);
    out.set(size > 0 ? [x / size, y / size, z / size, size] : [0, 0, 1, 0], 4 * face);
  }
  return out;
}

/** The faces at each point: those of point p are `list[first[p]] … list[first[p + 1] - 1]`. */
function facesAt(points: number, indices: Uint32Array): { first: Uint32Array; list: Uint32Array } {
  const first = new Uint32Array(points + 1);
  for (const point of indices) first[point + 1]++;
  for (let k = 0; k < points; k++) first[k + 1] += first[k];
  const next = first.slice();
  const list = new Uint32Array(indices.length);
  for (let corner = 0; corner < indices.length; corner++) {
    list[next[indices[corner]]++] = Math.floor(corner / 3);
  }
  return { first, list };
}
