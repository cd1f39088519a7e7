// A box that is dragged over the ground: told to the server at most twenty times a second.

import { Vector3 } from "three";
import type { Box } from "../protocol";
import { drives, type Source } from "../source";
import type { Engine } from "../view/engine";
import type { Rig } from "../view/rig";
import type { Drag } from "./hand";
import { Label } from "./label";
import { aim, onLevel } from "./pick";
import { chosen } from "./placing";

const EVERY = 50;
const TURN = Math.PI / 18;

export class BoxDrag implements Drag {
  private readonly label: Label;
  private readonly start: Box;
  private readonly off: Vector3;
  private now: Box;
  private told = 0;
  private later = 0;

  constructor(
    private readonly source: Source,
    private readonly engine: Engine,
    private readonly place: HTMLElement,
    private readonly rig: Rig,
    picked: { box: Box; at: Vector3 },
  ) {
    this.start = { ...picked.box };
    this.now = { ...picked.box };
    this.off = new Vector3(picked.box.x, picked.box.y, 0).sub(picked.at);
    this.off.z = picked.at.z;
    this.label = new Label(place);
    chosen.value = picked.box.id;
    engine.scenery?.boxes.hold(picked.box.id);
  }

  move(event: PointerEvent): void {
    const at = onLevel(aim(event, this.place, this.rig), this.off.z);
    if (!at) return;
    this.now = { ...this.now, x: at.x + this.off.x, y: at.y + this.off.y };
    this.label.set(event, `${this.now.x.toFixed(2)}, ${this.now.y.toFixed(2)} m`);
    this.changed();
  }

  wheel(event: WheelEvent): void {
    this.now = { ...this.now, yaw: this.now.yaw + Math.sign(event.deltaY) * TURN };
    this.changed();
  }

  end(): void {
    clearTimeout(this.later);
    const { x, y, yaw } = this.now;
    if (x !== this.start.x || y !== this.start.y || yaw !== this.start.yaw) {
      void this.source.send({ do: "move", thing: this.start.id, x, y, yaw }).then((answer) => {
        if (!answer.done) this.draw(this.allowed);
        this.away();
      });
    } else this.away();
    this.label.remove();
  }

  /** Back to where it was; who lost the wheel leaves it where it is. */
  cancel(): void {
    clearTimeout(this.later);
    const driving = drives(this.source);
    const { id, x, y, yaw } = this.start;
    if (this.told && driving) this.source.tell({ do: "move", thing: id, x, y, yaw });
    this.draw(driving ? this.start : this.allowed);
    this.away();
  }

  /** The last place that the server had it at. */
  private get allowed(): Box {
    return this.source.boxes.peek().find(({ id }) => id === this.start.id) ?? this.start;
  }

  private away(): void {
    this.label.remove();
    this.engine.scenery?.boxes.hold(null);
  }

  private draw({ x, y, z, yaw }: Box): void {
    this.engine.scenery?.boxes.put(this.start.id, { x, y, z, yaw });
  }

  private changed(): void {
    this.draw(this.now);
    clearTimeout(this.later);
    const wait = this.told + EVERY - performance.now();
    if (wait > 0) {
      this.later = window.setTimeout(() => this.tell(), wait);
      return;
    }
    this.tell();
  }

  private tell(): void {
    this.told = performance.now();
    const { id, x, y, yaw } = this.now;
    this.source.tell({ do: "move", thing: id, x, y, yaw });
  }
}
