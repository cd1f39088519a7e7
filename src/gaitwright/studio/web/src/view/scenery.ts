// The world as it stands: ground, shapes, boxes, light.

import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group, HemisphereLight, Mesh,
  MeshStandardMaterial, SphereGeometry, Vector3,
} from "three";
import { floats, integers } from "../bytes";
import type { Mesh as Triangles, World } from "../protocol";
import { Boxes } from "./boxes";
import { creased } from "./creased";
import { groundMaterial } from "./ground-material";
import { Heights } from "./heights";
import type { Palette } from "./palette";
import { welded } from "./weld";

/** Lower ground casts no shadows [m]. */
const CASTS = 0.12;
const SHADOW = 4;
const SUN = new Vector3(5, -6.5, 12);

export class Lights {
  readonly group = new Group();
  private readonly sun = new DirectionalLight("#fff4e2", 2.5);
  private readonly fill = new DirectionalLight("#cfe0ff", 0.8);
  private readonly sky = new HemisphereLight("#eaf2ff", "#b5afa4", 1.1);

  constructor() {
    const { sun } = this;
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.bias = -0.0004;
    sun.shadow.normalBias = 0.012;
    sun.shadow.radius = 3;
    this.fill.position.set(-6, 8, 5);
    this.group.add(sun, sun.target, this.fill, this.sky);
  }

  /** Shadows are where the robot is. */
  follow(place: Vector3, size: number): void {
    const reach = SHADOW * Math.max(1, size);
    const { camera } = this.sun.shadow;
    if (camera.right !== reach) {
      Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 10 * reach });
      camera.updateProjectionMatrix();
    }
    // in steps, so that edges of shadows do not crawl
    const step = (value: number) => Math.round(value * 4) / 4;
    this.sun.target.position.set(step(place.x), step(place.y), step(place.z));
    this.sun.position.copy(this.sun.target.position).addScaledVector(SUN, Math.max(1, size));
  }

  /** Where a machine is too slow for them. */
  withoutShadows(): void {
    this.sun.castShadow = false;
  }

  dye(palette: Palette): void {
    this.sun.intensity = palette.sun;
    this.sky.intensity = palette.sky;
  }
}

export class Scenery {
  readonly group = new Group();
  readonly heights: Heights;
  readonly boxes: Boxes;
  private readonly ground = groundMaterial();
  private readonly stone = new MeshStandardMaterial({ roughness: 0.85, side: DoubleSide });

  constructor(world: World) {
    const points = floats(world.ground.points);
    const indices = integers(world.ground.indices);
    this.heights = new Heights(points, indices);
    const ground = new Mesh(surface(points, indices), this.ground.material);
    ground.receiveShadow = true;
    ground.castShadow = this.heights.high - this.heights.low > CASTS;
    this.group.add(ground);
    for (const mesh of world.meshes) this.add(solid(mesh));
    for (const ball of world.spheres) {
      const shape = new SphereGeometry(ball.radius, 32, 20).translate(ball.x, ball.y, ball.z);
      this.add(shape);
    }
    this.boxes = new Boxes(world.boxes);
    this.group.add(this.boxes.group);
  }

  dye(palette: Palette): void {
    const { look } = this.ground;
    look.flatColour.value = new Color(palette.flat);
    look.steep.value = new Color(palette.steep);
    look.line.value = new Color(palette.line);
    this.stone.color.set(palette.shape);
    this.boxes.dye(palette);
  }

  dispose(): void {
    this.group.traverse((one) => {
      if (!(one instanceof Mesh)) return;
      one.geometry.dispose();
      one.material.dispose();
    });
  }

  private add(shape: BufferGeometry): void {
    const mesh = new Mesh(shape, this.stone);
    mesh.castShadow = mesh.receiveShadow = true;
    this.group.add(mesh);
  }
}

function surface(points: Float32Array, indices: Uint32Array): BufferGeometry {
  const { position, normal, index } = creased(points, indices);
  const shape = new BufferGeometry();
  shape.setAttribute("position", new BufferAttribute(position, 3));
  shape.setAttribute("normal", new BufferAttribute(normal, 3));
  shape.setIndex(new BufferAttribute(index, 1));
  return shape;
}

function solid(mesh: Triangles): BufferGeometry {
  const { points, indices } = welded(floats(mesh.points), integers(mesh.indices));
  return surface(points, indices);
}
