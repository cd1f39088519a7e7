// One renderer for all views: scenery, robots, overlays, drawn once per picture of the display.

import { Color, Group, NeutralToneMapping, PCFShadowMap, Scene, WebGLRenderer } from "three";
import type { World } from "../protocol";
import type { Source } from "../source";
import type { Theme } from "../shell/theme";
import { Pose } from "./kinematics";
import { Overlays } from "./overlays";
import { PALETTES } from "./palette";
import { type Rig, spread } from "./rig";
import { Quality } from "./quality";
import { paint, Robots } from "./robots";
import { Lights, Scenery } from "./scenery";
import { sameGround } from "./same";
import type { SeeThrough } from "./see-through";
import { skyTexture } from "./sky";

export interface View {
  rig: Rig;
  /** Where it is on the page. */
  place: HTMLElement;
  /** What it sees through. */
  through: SeeThrough;
}

export class Engine {
  readonly scene = new Scene();
  readonly renderer: WebGLRenderer;
  views: View[] = [];
  scenery: Scenery | null = null;
  poses: Pose[] = [];
  readonly overlays: Overlays;
  /** What tools draw. */
  readonly hands = new Group();
  private readonly quality: Quality;
  private world: World | null = null;
  private robots: Robots | null = null;
  private readonly paint = paint();
  private readonly lights = new Lights();
  private theme: Theme = "light";
  private rows: Float32Array[] = [];
  private before = 0;
  private running = 0;
  watched = 0;
  /** Called after each picture. */
  onDrawn: (() => void)[] = [];

  constructor(readonly canvas: HTMLCanvasElement, readonly source: Source) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: false });
    this.quality = new Quality(this.renderer, () => this.lights.withoutShadows());
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.setScissorTest(true);
    this.overlays = new Overlays(this);
    this.scene.add(this.lights.group, this.overlays.group, this.hands);
  }

  start(): void {
    const draw = (now: number) => {
      this.running = requestAnimationFrame(draw);
      this.draw(now);
    };
    this.running = requestAnimationFrame(draw);
  }

  stop(): void {
    cancelAnimationFrame(this.running);
    this.renderer.dispose();
  }

  /** Builds a world anew, unless only its boxes are others: `Boxes.replace` has those. */
  arrange(world: World | null): void {
    const before = this.world;
    this.world = world;
    if (world && this.scenery && sameGround(world, before)) return;
    this.scenery?.dispose();
    this.robots?.dispose();
    if (this.scenery) this.scene.remove(this.scenery.group);
    if (this.robots) this.scene.remove(this.robots.group);
    this.scenery = this.robots = null;
    this.poses = [];
    if (!world) return;
    this.scenery = new Scenery(world);
    this.poses = world.robots.map((robot) => new Pose(robot));
    this.robots = new Robots(world.robots, this.paint);
    this.robots.group.visible = false;
    this.scene.add(this.scenery.group, this.robots.group);
    this.overlays.arrange(world);
    this.dye(this.theme);
  }

  dye(theme: Theme): void {
    this.theme = theme;
    const palette = PALETTES[theme];
    this.scenery?.dye(palette);
    this.lights.dye(palette);
    this.scene.background = skyTexture(new Color(palette.skyHigh), new Color(palette.skyLow));
  }

  /** Height of what stands at a place. */
  height(x: number, y: number): number {
    const ground = this.scenery?.heights.at(x, y) ?? NaN;
    const top = this.scenery?.boxes.top(x, y) ?? -Infinity;
    return Number.isNaN(ground) ? (top > -Infinity ? top : 0) : Math.max(ground, top);
  }

  /** The row that is drawn of a robot. */
  row(robot: number): Float32Array | null {
    return this.rows[robot] ?? null;
  }

  draw(now: number): void {
    const dt = Math.min(0.1, Math.max(0, (now - this.before) / 1000));
    this.before = now;
    this.take(now);
    const pose = this.rows.length ? this.poses[Math.min(this.watched, this.poses.length - 1)] : null;
    if (pose) this.lights.follow(pose.base.position, spread(pose.robot));
    this.overlays.update(now);
    this.fit();
    for (const view of this.views) this.drawView(view, pose ?? null, dt);
    for (const then of this.onDrawn) then();
    this.quality.drawn(now);
  }

  private take(now: number): void {
    const layout = this.source.layout.value;
    if (!layout || !this.robots) return;
    let known = true;
    this.poses.forEach((pose, k) => {
      this.rows[k] = this.rows[k]?.length === layout.width ? this.rows[k] : new Float32Array(layout.width);
      if (this.source.sample(k, now, this.rows[k])) pose.set(this.rows[k], layout);
      else known = false;
    });
    this.rows.length = known ? this.poses.length : 0;
    this.robots.group.visible = known && this.poses.length > 0;
    if (this.robots.group.visible) this.robots.pose(this.poses);
  }

  private fit(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = this.renderer.getPixelRatio();
    const fits =
      this.canvas.width === Math.floor(clientWidth * ratio) && this.canvas.height === Math.floor(clientHeight * ratio);
    if (!fits && clientWidth > 0) this.renderer.setSize(clientWidth, clientHeight, false);
  }

  private drawView({ rig, place, through }: View, pose: Pose | null, dt: number): void {
    const all = this.canvas.getBoundingClientRect();
    const here = place.getBoundingClientRect();
    if (here.width < 2 || here.height < 2) return;
    rig.update(pose, dt);
    rig.camera.aspect = here.width / here.height;
    rig.camera.updateProjectionMatrix();
    if (this.scenery) {
      through.look(this.scenery.boxes.all, rig.camera.position, pose, dt);
      this.scenery.boxes.seeThrough(through.shares);
    }
    const [x, y] = [here.left - all.left, all.bottom - here.bottom];
    this.renderer.setViewport(x, y, here.width, here.height);
    this.renderer.setScissor(x, y, here.width, here.height);
    this.renderer.render(this.scene, rig.camera);
  }
}
