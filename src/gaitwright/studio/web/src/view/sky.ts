// A quiet background: one colour above, another one at the horizon.

import { type Color, DataTexture, LinearFilter, RGBAFormat, SRGBColorSpace } from "three";

const known = new Map<string, DataTexture>();

export function skyTexture(high: Color, low: Color): DataTexture {
  const key = high.getHexString() + low.getHexString();
  const before = known.get(key);
  if (before) return before;
  const rows = 64;
  const data = new Uint8Array(rows * 4);
  for (let k = 0; k < rows; k++) {
    const mixed = low.clone().lerp(high, (k / (rows - 1)) ** 0.8).convertLinearToSRGB();
    data.set([mixed.r, mixed.g, mixed.b, 1].map((value) => Math.round(255 * value)), 4 * k);
  }
  const texture = new DataTexture(data, 1, rows, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  known.set(key, texture);
  return texture;
}
