// The panels of the docks. A panel is registered by one line here.

import type { ComponentType } from "preact";
import { CurvesPanel } from "./curves/panel";
import { DrivePanel } from "./drive/panel";
import { WorldPanel } from "./drive/world-panel";
import { MapPanel } from "./map/panel";
import { PlotsPanel } from "./plots/panel";
import { RecordingsPanel } from "./recordings/panel";
import { RulesPanel } from "./rules/panel";
import type { Source } from "./source";
import { StatusPanel } from "./state/panel";
import { TeachPanel } from "./teach/panel";

export interface Panel {
  id: string;
  title: string;
  dock: "left" | "right";
  view: ComponentType<{ source: Source }>;
  /** Whether it makes sense for a recording, too. */
  replay?: boolean;
}

export const panels: Panel[] = [
  { id: "drive", title: "Drive", dock: "left", view: DrivePanel },
  { id: "world", title: "World", dock: "left", view: WorldPanel },
  { id: "teach", title: "Teach", dock: "left", view: TeachPanel },
  { id: "recordings", title: "Record", dock: "left", view: RecordingsPanel },
  { id: "status", title: "Status", dock: "right", view: StatusPanel },
  { id: "rules", title: "Rules", dock: "right", view: RulesPanel },
  { id: "curves", title: "Curves", dock: "right", view: CurvesPanel },
  { id: "map", title: "Map", dock: "right", view: MapPanel },
  { id: "plots", title: "Plots", dock: "right", view: PlotsPanel, replay: true },
];
