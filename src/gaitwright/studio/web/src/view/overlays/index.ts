// All overlays, switched by their names.

import { Group } from "three";
import type { World } from "../../protocol";
import type { Engine } from "../engine";
import { spread } from "../rig";
import { type OverlayId, shown } from "../settings";
import { Footholds } from "./footholds";
import { Forces } from "./forces";
import { Ghost } from "./ghost";
import type { Moment, Overlay } from "./overlay";
import { Reach } from "./reach";
import { RouteLine } from "./route";
import { SeenGround } from "./seen";
import { Support } from "./support";
import { Trail } from "./trail";
import { VelocityArrow } from "./velocity";

export class Overlays {
  readonly group = new Group();
  private readonly all: Record<OverlayId, Overlay> = {
    forces: new Forces(),
    support: new Support(),
    footholds: new Footholds(),
    route: new RouteLine(),
    velocity: new VelocityArrow(),
    ghost: new Ghost(),
    seen: new SeenGround(),
    reach: new Reach(),
    trail: new Trail(),
  };

  constructor(private readonly engine: Engine) {
    for (const { object } of Object.values(this.all)) this.group.add(object);
  }

  arrange(world: World): void {
    for (const overlay of Object.values(this.all)) overlay.arrange?.(world);
  }

  update(_now: number): void {
    const { engine } = this;
    const layout = engine.source.layout.peek();
    const row = engine.row(engine.watched);
    const pose = engine.poses[engine.watched];
    this.group.visible = Boolean(layout && row && pose);
    if (!layout || !row || !pose) return;
    const height = (x: number, y: number) => engine.height(x, y);
    const moment: Moment = { source: engine.source, layout, row, pose, size: spread(pose.robot), height };
    const on = shown.peek();
    for (const [id, overlay] of Object.entries(this.all) as [OverlayId, Overlay][]) {
      const there = overlay.needs?.every((name) => layout.has(name)) ?? true;
      overlay.object.visible = there && (on[id] ?? false);
      if (overlay.object.visible) overlay.update(moment);
    }
  }
}
