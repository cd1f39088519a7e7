// The curve on the desk: what is chosen, its points as they are being moved, what became of the last edit.

import { computed, signal } from "@preact/signals";
import type { Curve, CurveKind, Edited, Preview, Robot } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";
import { remembered } from "../ui/remembered";
import { pointAt, withPoint } from "./geometry";

export const kind = remembered<CurveKind>("curve.kind", "cycle");
/** "": the skill in use. */
export const skill = remembered("curve.skill", "");
export const leg = signal(0);
/** Whether an edit counts for the other legs, too. */
export const mirror = remembered("curve.mirror", true);

/** Whether an edit is how the foot gets over what is ahead of it, and not how it goes at all times. Such points
    wait until all of them are where they are to be. */
export const obstacle = signal(false);
export const isOver = computed(() => obstacle.value && curve.value?.kind === "cycle");
/** The last edit at an obstacle, as a rule. */
export const learned = signal("");

export const curve = signal<Curve | null>(null);
/** Why there is none. */
export const missing = signal("");
/** The points as they are being moved; `null`: as the server has them. */
export const draft = signal<number[][] | null>(null);
export const points = computed(() => draft.value ?? curve.value?.points ?? []);
export const dragged = signal<{ chart: string; point: number } | null>(null);
export const busy = signal(false);
export const preview = signal<Preview | null>(null);
/** What was refused: the points as they would have been, and which of them it is about. */
export const refused = signal<{ chart: string; row: number[] | null; because: string } | null>(null);
/** What was said of the last undo, or of keeping. */
export const said = signal<{ text: string; bad: boolean } | null>(null);

const UNCHANGED = /^no (torque|point) of .* was (changed|moved)/;

/** Looks at the curve again; what is being moved stays as it is. */
export async function look(source: Source): Promise<void> {
  const asked = { kind: kind.peek(), skill: skill.peek(), leg: leg.peek() };
  const { more, because } = await ask<{ curve: Curve }>(source, { do: "curve", ...asked });
  const isMeant = asked.kind === kind.peek() && asked.skill === skill.peek() && asked.leg === leg.peek();
  if (!isMeant || busy.peek()) return;
  missing.value = because;
  show(more?.curve ?? null);
}

function show(now: Curve | null): void {
  const before = curve.peek();
  const isOther = now?.kind !== before?.kind || now?.skill !== before?.skill || now?.leg !== before?.leg;
  if (isOther) {
    draft.value = null;
    forget();
  }
  curve.value = now;
}

/** What was said of the last edit is out of date. */
function forget(): void {
  refused.value = preview.value = said.value = null;
  learned.value = "";
}

/** A point is taken hold of: the curve stays on the desk, whatever the robot does next. */
export function hold(chart: string, point: number): void {
  dragged.value = { chart, point };
  refused.value = null;
  pin();
}

function pin(): void {
  const now = curve.peek();
  if (now) skill.value = now.skill;
}

let robotName = "";

/** What was chosen, as far as a robot has it; points that do not count yet are of no other robot. */
export function fit(robot: Robot, skills: string[]): void {
  if (leg.peek() >= robot.legs.length) leg.value = 0;
  if (!skills.includes(skill.peek())) skill.value = "";
  if (robotName && robot.name !== robotName) {
    draft.value = curve.value = null;
    forget();
  }
  robotName = robot.name;
}

/** Another curve is chosen. */
export function choose(source: Source, change: () => void): void {
  change();
  void look(source);
}

/** The draft is what the curve is to be: checked and seen in physics, then taken or not. */
export async function submit(source: Source, chart: string, point: number): Promise<void> {
  const [now, wanted] = [curve.peek(), draft.peek()];
  if (!now || !wanted || busy.peek()) return;
  busy.value = true;
  forget();
  const { more, because } = await ask<Edited>(source, {
    do: "edit",
    kind: now.kind,
    skill: now.skill,
    leg: now.legs.indexOf(now.leg),
    points: wanted,
    mirror: mirror.peek(),
    obstacle: isOver.peek(),
  });
  busy.value = false;
  if (more?.taken) {
    draft.value = null;
    preview.value = more.preview;
    learned.value = more.learned ?? "";
    curve.value = more.curve;
    return;
  }
  const why = more?.because ?? because;
  if (UNCHANGED.test(why)) return; // a point more or less on the same line: it counts once it is moved
  if (!isOver.peek()) draft.value = null;
  preview.value = more?.preview ?? null;
  const about = more?.point ? more.point - 1 : point;
  refused.value = { chart, row: wanted[about] ?? null, because: why };
}

/** A point was let go, or taken out. */
export function settle(source: Source, chart: string, point: number): void {
  if (isOver.peek()) return;
  void submit(source, chart, point);
}

/** From now on edits are of how the foot gets over what is ahead, or of how it goes at all times. */
export function turnOver(on: boolean): void {
  obstacle.value = on;
  draft.value = null;
  forget();
}

/** Puts a point on the line; it counts once it is moved. */
export function add(phase: number): void {
  const now = curve.peek();
  if (!now || busy.peek()) return;
  const { most } = now.limits;
  const row = pointAt(now, points.peek(), phase);
  forget();
  pin();
  if (points.peek().length >= most) {
    said.value = { text: `this curve has at most ${most} points`, bad: true };
  } else if (row) {
    draft.value = withPoint(points.peek(), row);
  } else {
    said.value = { text: "a point there would be too near another, or outside the swing", bad: true };
  }
}

/** Takes a point out. */
export function remove(source: Source, chart: string, k: number): void {
  const now = curve.peek();
  if (!now || busy.peek()) return;
  const left = points.peek().toSpliced(k, 1);
  forget();
  pin();
  draft.value = JSON.stringify(left) === JSON.stringify(now.points) ? null : left;
  if (draft.peek()) settle(source, chart, Math.min(k, left.length - 1));
}

/** One edit back, or forward; points that do not count yet go first. */
export async function step(source: Source, how: "undo" | "redo"): Promise<void> {
  if (busy.peek()) return;
  forget();
  if (how === "undo" && draft.peek()) {
    draft.value = null;
    return;
  }
  const { because } = await ask(source, { do: how });
  if (because) said.value = { text: because, bad: true };
  await look(source);
}

export async function save(source: Source): Promise<void> {
  const { more, because } = await ask<{ sentences: string[] }>(source, { do: "save" });
  said.value = { text: because || (more?.sentences.join("; ") ?? ""), bad: Boolean(because) };
}
