// Heights as colours: low to high, lit from the north-west, in a picture of one pixel a cell.

import type { Theme } from "../shell/theme";

type Colour = [number, number, number];

const RAMPS: Record<Theme, [Colour, Colour, Colour]> = {
  light: [[137, 170, 196], [232, 229, 216], [190, 142, 84]],
  dark: [[42, 74, 104], [74, 79, 83], [176, 126, 74]],
};
const LIGHT = 1.6;

export interface Range {
  low: number;
  level: number;
  high: number;
}

/** Colours of a grid of heights, rows from low y on, as a picture with y upwards; unknown is clear. */
export function relief(
  heights: ArrayLike<number>, columns: number, spacing: number, range: Range, theme: Theme,
): HTMLCanvasElement {
  const rows = heights.length / columns;
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d")!;
  const image = context.createImageData(columns, rows);
  const ramp = RAMPS[theme];
  for (let k = 0; k < heights.length; k++) {
    const z = heights[k];
    if (Number.isNaN(z)) continue;
    const column = k % columns;
    const row = (k - column) / columns;
    const west = column > 0 ? heights[k - 1] : NaN;
    const north = row + 1 < rows ? heights[k + columns] : NaN;
    const slope = (Number.isNaN(west) ? 0 : z - west) + (Number.isNaN(north) ? 0 : z - north);
    const light = Math.max(0.6, Math.min(1.35, 1 + (LIGHT * slope) / (spacing * 6)));
    const at = 4 * ((rows - 1 - row) * columns + column);
    const colour = mixed(ramp, z, range);
    for (let c = 0; c < 3; c++) image.data[at + c] = Math.min(255, colour[c] * light);
    image.data[at + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/** The colour of a height: the middle one is level ground. */
function mixed([low, level, high]: [Colour, Colour, Colour], z: number, range: Range): Colour {
  const below = z < range.level;
  const end = below ? low : high;
  const far = below ? range.level - range.low : range.high - range.level;
  const share = Math.min(1, Math.abs(z - range.level) / Math.max(far, 1e-6));
  return [0, 1, 2].map((c) => level[c] + share * (end[c] - level[c])) as Colour;
}
