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
    box: "#c7ad86", held: "#f08c4a", shape: "#b9b1a2", sun: 2.2, sky: 1.7,
  },
  dark: {
    skyHigh: "#10151a", skyLow: "#2b343d", flat: "#4c5053", steep: "#3b3b3a", line: "#858b90",
    box: "#84725a", held: "#e08a4a", shape: "#77736a", sun: 2.2, sky: 1.15,
  },
};
