// Points at the same place made one, so that normals can be smooth across faces that were told apart.

export function welded(points: Float32Array, indices: Uint32Array): { points: Float32Array; indices: Uint32Array } {
  const known = new Map<string, number>();
  const kept: number[] = [];
  const place = new Uint32Array(points.length / 3);
  for (let k = 0; k < place.length; k++) {
    const [x, y, z] = points.subarray(3 * k, 3 * k + 3);
    const key = `${Math.round(x * 1e4)} ${Math.round(y * 1e4)} ${Math.round(z * 1e4)}`;
    let at = known.get(key);
    if (at === undefined) {
      at = kept.length / 3;
      known.set(key, at);
      kept.push(x, y, z);
    }
    place[k] = at;
  }
  return { points: new Float32Array(kept), indices: indices.map((index) => place[index]) };
}
