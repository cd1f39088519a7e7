// A new box under the pointer, before it is placed.

import { BoxGeometry, Mesh, MeshStandardMaterial, type Vector3 } from "three";
import type { Source } from "../source";
import type { Engine } from "../view/engine";
import { placing, size } from "./placing";

export class PlacingGhost {
  private readonly mesh: Mesh;

  constructor(private readonly engine: Engine) {
    const paint = new MeshStandardMaterial({ color: "#f76707", transparent: true, opacity: 0.55 });
    this.mesh = new Mesh(new BoxGeometry(1, 1, 1), paint);
    this.mesh.visible = false;
    engine.hands.add(this.mesh);
  }

  show(at: Vector3): void {
    const high = size.high.peek();
    this.mesh.scale.set(size.long.peek(), size.wide.peek(), high);
    this.mesh.position.set(at.x, at.y, this.engine.scenery!.heights.at(at.x, at.y) + high / 2 || at.z);
    this.mesh.rotation.z = this.yaw;
    this.mesh.visible = true;
  }

  hide(): void {
    this.mesh.visible = false;
  }

  place(source: Source, at: Vector3): void {
    void source
      .send({
        do: "place", x: at.x, y: at.y, lx: size.long.peek(), ly: size.wide.peek(), height: size.high.peek(),
        yaw: this.yaw,
      })
      .then((answer) => {
        if (answer.done) placing.value = false;
      });
    this.hide();
  }

  dispose(): void {
    this.engine.hands.remove(this.mesh);
    this.mesh.geometry.dispose();
  }

  private get yaw(): number {
    return (size.yaw.peek() * Math.PI) / 180;
  }
}
