// A push: dragged from the robot's body, as strong as the arrow is long.

import { Vector3 } from "three";
import type { Source } from "../source";
import { Arrows } from "../view/arrows";
import type { Engine } from "../view/engine";
import type { Rig } from "../view/rig";
import type { Drag } from "./hand";
import { Label } from "./label";
import { aim, onLevel } from "./pick";

/** N·s/kg per metre of arrow: so much faster, in m/s, is the robot after it. */
const PER_METRE = 1.0;
const MOST = 2.0;

export class PushDrag implements Drag {
  private readonly arrow = new Arrows(1, "#f76707", 0.014);
  private readonly label: Label;
  private readonly along = new Vector3();
  private last: PointerEvent | null = null;

  constructor(
    private readonly source: Source,
    private readonly engine: Engine,
    private readonly place: HTMLElement,
    private readonly rig: Rig,
  ) {
    this.label = new Label(place);
    engine.onDrawn.push(this.follow);
    engine.hands.add(this.arrow.group);
  }

  private get impulse(): number {
    return Math.min(MOST, PER_METRE * this.along.length());
  }

  move(event: PointerEvent): void {
    this.last = event;
    this.follow();
  }

  /** Robot and camera go on while the pointer rests. */
  private readonly follow = (): void => {
    const event = this.last;
    if (!event) return;
    const from = this.engine.poses[this.engine.watched].base.position;
    const to = onLevel(aim(event, this.place, this.rig), from.z);
    if (!to) return;
    this.along.copy(to).sub(from).setZ(0).clampLength(0, MOST / PER_METRE);
    this.arrow.set(0, from, this.along);
    this.label.set(event, `push ${this.impulse.toFixed(2)} N·s/kg`);
  };

  end(_event: PointerEvent, moved: boolean): void {
    const direction = Math.atan2(this.along.y, this.along.x);
    if (moved && this.impulse > 0.02) void this.source.send({ do: "push", impulse: this.impulse, direction });
    this.cancel();
  }

  cancel(): void {
    this.engine.onDrawn = this.engine.onDrawn.filter((then) => then !== this.follow);
    this.engine.hands.remove(this.arrow.group);
    this.label.remove();
  }
}
