// Boxes that stand in the world, and things that move: one draw, each can be taken hold of.

import {
  BoxGeometry, Color, DynamicDrawUsage, Group, InstancedBufferAttribute, InstancedMesh, Matrix4, Quaternion,
  type Raycaster, Vector3,
} from "three";
import type { Box, Thing } from "../protocol";
import { edged } from "./edged";
import type { Palette } from "./palette";

const UP = new Vector3(0, 0, 1);
const matrix = new Matrix4();
const turn = new Quaternion();
const place = new Vector3();
const size = new Vector3();
const SPARE = 64;
/** So many at most are seen through in one view. */
const MOST_CLEAR = 24;

export type Id = Box["id"];

export class Boxes {
  readonly group = new Group();
  private mesh: InstancedMesh;
  private boxes: Box[];
  private readonly material = edged(false);
  private readonly glass = this.made(MOST_CLEAR, true);
  private hasClear = false;
  private colour = new Color();
  private lightColour = new Color();
  private lit: Id | null = null;
  private held: Id | null = null;

  constructor(boxes: Box[]) {
    this.boxes = boxes.map((box) => ({ ...box }));
    this.mesh = this.made(this.boxes.length + SPARE);
    this.draw();
  }

  private made(most: number, clear = false): InstancedMesh {
    const shape = new BoxGeometry(1, 1, 1);
    const share = new InstancedBufferAttribute(new Float32Array(most).fill(clear ? 0 : 1), 1);
    shape.setAttribute("share", share.setUsage(DynamicDrawUsage));
    const mesh = new InstancedMesh(shape, clear ? edged(true) : this.material, most);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.castShadow = mesh.receiveShadow = !clear;
    if (clear) mesh.count = 0;
    mesh.frustumCulled = false;
    this.group.add(mesh);
    return mesh;
  }

  /** Other boxes; one that is held stays in the hand. */
  replace(boxes: Box[]): void {
    const held = this.held === null ? undefined : this.find(this.held);
    const moving = this.boxes.filter(({ id }) => isMoving(id));
    this.boxes = [...boxes.map((box) => (held && box.id === held.id ? held : { ...box })), ...moving];
    if (this.boxes.length > this.mesh.instanceMatrix.count) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = this.made(this.boxes.length + SPARE);
    }
    this.draw();
  }

  find(id: Id): Box | undefined {
    return this.boxes.find((box) => box.id === id);
  }

  /** Where the things are that move by themselves: these, and no others. */
  move(things: readonly Thing[]): void {
    const still = this.boxes.filter(({ id }) => !isMoving(id));
    const room = this.mesh.instanceMatrix.count - still.length;
    const moving = things.slice(0, room).map((thing) => ({ ...thing, id: `moving ${thing.id}` }));
    if (!moving.length && still.length === this.boxes.length) return;
    this.boxes = [...still, ...moving];
    this.draw();
  }

  /** Another place for a box, as the hand has it. */
  put(id: Id, place: Pick<Box, "x" | "y" | "z" | "yaw">): void {
    const box = this.find(id);
    if (box) Object.assign(box, place);
    this.draw();
  }

  /** All of them, as they are now. */
  get all(): readonly Box[] {
    return this.boxes;
  }

  /** Shows some boxes, by how clear a share of them is seen, as glass: for one view, before it is drawn. */
  seeThrough(clear: ReadonlyMap<Id, number>): void {
    if (!clear.size && !this.hasClear) return;
    this.hasClear = clear.size > 0;
    const whole = this.mesh.geometry.getAttribute("share");
    const parts = this.glass.geometry.getAttribute("share");
    let count = 0;
    this.boxes.forEach(({ id }, k) => {
      const share = clear.get(id);
      const isClear = share !== undefined && count < MOST_CLEAR;
      whole.setX(k, isClear ? 0 : 1);
      if (!isClear) return;
      this.mesh.getMatrixAt(k, matrix);
      this.glass.setMatrixAt(count, matrix);
      this.glass.setColorAt(count, id === this.lit ? this.lightColour : this.colour);
      parts.setX(count, share);
      count += 1;
    });
    this.glass.count = count;
    whole.needsUpdate = parts.needsUpdate = this.glass.instanceMatrix.needsUpdate = true;
    if (this.glass.instanceColor) this.glass.instanceColor.needsUpdate = true;
  }

  /** The box that a ray meets first, and how far away. */
  pick(ray: Raycaster): { box: Box; far: number } | null {
    this.mesh.computeBoundingSphere();
    const [first] = ray.intersectObject(this.mesh);
    return first?.instanceId === undefined ? null : { box: this.boxes[first.instanceId], far: first.distance };
  }

  /** Height of the highest box at a place; −∞ where there is none. */
  top(x: number, y: number): number {
    let top = -Infinity;
    for (const box of this.boxes) {
      const [dx, dy] = [x - box.x, y - box.y];
      const [c, s] = [Math.cos(box.yaw), Math.sin(box.yaw)];
      const inside = Math.abs(c * dx + s * dy) <= box.lx / 2 && Math.abs(c * dy - s * dx) <= box.ly / 2;
      if (inside) top = Math.max(top, box.z + box.lz / 2);
    }
    return top;
  }

  /** Takes one into the hand: where it is, the hand says. */
  hold(id: Id | null): void {
    this.held = id;
  }

  /** Shows which one is chosen. */
  light(id: Id | null): void {
    if (id === this.lit) return;
    this.lit = id;
    this.draw();
  }

  dye(palette: Palette): void {
    this.colour.set(palette.box);
    this.lightColour.set(palette.held);
    this.draw();
  }

  private draw(): void {
    this.boxes.forEach((box, k) => {
      turn.setFromAxisAngle(UP, box.yaw);
      matrix.compose(place.set(box.x, box.y, box.z), turn, size.set(box.lx, box.ly, box.lz));
      this.mesh.setMatrixAt(k, matrix);
      this.mesh.setColorAt(k, box.id === this.lit ? this.lightColour : this.colour);
    });
    this.mesh.count = this.boxes.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }
}

/** Whether it moves by itself: nobody takes hold of it. */
export function isMoving(id: Id): boolean {
  return typeof id === "string" && id.startsWith("moving ");
}
