// Colours of the 3-D views in both themes.

import type { Theme } from "../shell/theme";

export interface Palette {
  skyHigh: string;
  skyLow: string;
  flat: string;
  steep: string;
  line: string;
  box: string;
  held: string;
  shape: string;
  sun: number;
  sky: number;
}

export const PALETTES: Record<Theme, Palette> = {
  light: {
    skyHigh: "#c3d0dd", skyLow: "#edf1f5", flat: "#dcd8ce", steep: "#b5ab98", line: "#8d8778",
    box: "#c89f62", held: "#e8590c", shape: "#b3a78f", sun: 2.6, sky: 1.25,
  },
  dark: {
    skyHigh: "#10151a", skyLow: "#2b343d", flat: "#4c5053", steep: "#3b3b3a", line: "#858b90",
    box: "#9a7a4c", held: "#ff922b", shape: "#77705f", sun: 2.3, sky: 0.9,
  },
};
