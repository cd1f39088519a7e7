// Normals of a mesh that are smooth over gentle slopes and sharp at edges.

/** Corners one by one, with normals averaged over those faces at a corner that bend by less than `bend` [rad]. */
export function creased(
  points: Float32Array,
  indices: Uint32Array,
  bend = 0.6,
): { position: Float32Array; normal: Float32Array } {
  const faces = indices.length / 3;
  const flat = faceNormals(points, indices);
  const { first, list } = facesAt(points.length / 3, indices);
  const position = new Float32Array(indices.length * 3);
  const normal = new Float32Array(indices.length * 3);
  const least = Math.cos(bend);
  for (let face = 0; face < faces; face++) {
    const fx = flat[4 * face];
    const fy = flat[4 * face + 1];
    const fz = flat[4 * face + 2];
    for (let corner = 3 * face; corner < 3 * face + 3; corner++) {
      const point = indices[corner];
      let x = 0;
      let y = 0;
      let z = 0;
      for (let k = first[point]; k < first[point + 1]; k++) {
        const at = 4 * list[k];
        if (fx * flat[at] + fy * flat[at + 1] + fz * flat[at + 2] < least) continue;
        const weight = flat[at + 3];
        x += weight * flat[at];
        y += weight * flat[at + 1];
        z += weight * flat[at + 2];
      }
      const size = Math.hypot(x, y, z) || 1;
      normal[3 * corner] = x / size;
      normal[3 * corner + 1] = y / size;
      normal[3 * corner + 2] = z / size;
      for (let k = 0; k < 3; k++) position[3 * corner + k] = points[3 * point + k];
    }
  }
  return { position, normal };
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
