// Where each foot can be put from where the body is.

import { Group } from "three";
import type { Scan } from "../../protocol";
import { Ribbon } from "../ribbon";
import type { Moment, Overlay } from "./overlay";

export class Reach implements Overlay {
  readonly object = new Group();
  private readonly lines: Ribbon[] = [];
  private drawn: Scan | null = null;

  update({ source, size }: Moment): void {
    const scan = source.scan.peek();
    if (scan === this.drawn) return;
    this.drawn = scan;
    const reach = scan?.reach ?? [];
    reach.forEach((outline, k) => {
      this.lines[k] ??= this.line();
      this.lines[k].scale = size;
      this.lines[k].set(outline.map(([x, y, z]) => [x, y, z + 0.005]), true);
    });
    for (let k = reach.length; k < this.lines.length; k++) this.lines[k].mesh.visible = false;
  }

  private line(): Ribbon {
    const line = new Ribbon("#7048e8", 0.005, 0.7);
    this.object.add(line.mesh);
    return line;
  }
}
