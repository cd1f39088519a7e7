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
    skyHigh: "#c3d0dd", skyLow: "#edf1f5", flat: "#dcdad4", steep: "#b9b2a5", line: "#8b8880",
    box: "#d2c3a8", held: "#f08c4a", shape: "#b9b1a2", sun: 2.2, sky: 1.7,
  },
  dark: {
    skyHigh: "#10151a", skyLow: "#2b343d", flat: "#50555a", steep: "#3e4042", line: "#858d94",
    box: "#8f8475", held: "#e08a4a", shape: "#77736a", sun: 2.2, sky: 1.15,
  },
};
