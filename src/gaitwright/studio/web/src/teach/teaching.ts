// What a person is about to teach: what is said in the form, what it would do, what was learned last.

import { effect, signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Tried } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";

export type Field = "skill" | "speed" | "about" | "name" | "form";

export interface Said {
  skill: string;
  /** [m/s]; "": as the skill is meant */
  speed: string;
  about: string;
  name: string;
}

export const NOTHING: Said = { skill: "", speed: "", about: "", name: "" };

export const said = signal<Said>(NOTHING);
export const tried = signal<Tried | null>(null);
/** Why something was refused, and beside which field that stands. */
export const refused = signal<{ field: Field | "keep" | "ok"; because: string } | null>(null);
/** The lesson that was learned last. */
export const learned = signal("");
export const waits = signal(false);

/** What is asked over the views of what was tried; `told`: by the studio, because a person showed it. */
export const proposed = signal<{ question: string; told: boolean } | null>(null);

/** Whether time was stopped so that “here” stays here. */
let stopped = false;

/** The field that a sentence is about. */
export function fieldOf(because: string): Field {
  if (/\bm\/s\b|speed/.test(because)) return "speed";
  if (/^no number|\bnumber\b/.test(because)) return "about";
  if (/^no skill|\bskill\b/.test(because)) return "skill";
  return /\bname\b|called/.test(because) ? "name" : "form";
}

/** Says what is right here, to see what it would do. */
export async function tellWhatIsRight(source: Source): Promise<void> {
  const { skill, speed, about, name } = said.peek();
  if (!skill) {
    refused.value = { field: "skill", because: "say which skill is right" };
    return;
  }
  const meant = speed.trim() ? { speed: Number(speed.replace(",", ".")) } : {};
  if (Number.isNaN(meant.speed)) {
    refused.value = { field: "speed", because: `${speed} is no number` };
    return;
  }
  refused.value = null;
  waits.value = true;
  const { more, because } = await ask<Tried>(source, { do: "right", skill, ...meant, about, name: name.trim() });
  waits.value = false;
  propose(more, null);
  if (because) refused.value = { field: fieldOf(because), because };
}

/** Lays what a lesson would do before its teacher. */
export function propose(more: Tried | null, asked: typeof proposed.value): void {
  refused.value = null;
  tried.value = more;
  proposed.value = more && asked;
}

/** One rule before another, as a lesson; why not, where that cannot be. */
export async function order(source: Source, rule: string, before: string): Promise<string> {
  const { more, because } = await ask<Tried>(source, { do: "order", rule, before });
  if (more) propose(more, { question: `${rule} before ${before}?`, told: false });
  return because;
}

/** Nothing that was tried in a run stays on the page after it. */
export function useOwnRun(source: Source): void {
  useEffect(
    () =>
      effect(() => {
        const skills = source.hello.value?.choices.skills ?? [];
        if (!skills.includes(said.peek().skill)) said.value = { ...said.peek(), skill: "" };
        propose(null, null);
        stopped = false;
      }),
    [source],
  );
}

/** What was tried, and is shown, is learned; where another lesson is open meanwhile, the studio refuses. */
export async function keep(source: Source): Promise<void> {
  const lesson = tried.peek()?.lesson ?? "";
  const { more, because } = await ask<{ lesson: string }>(source, { do: "keep", lesson });
  if (more) {
    tried.value = null;
    said.value = NOTHING;
  }
  settle(source, more, because, "keep");
}

/** What was tried is not learned. */
export async function drop(source: Source): Promise<void> {
  tried.value = null;
  const { because } = await ask(source, { do: "back" });
  refused.value = because ? { field: "keep", because } : null;
  goOn(source);
}

/** What it does now is right. */
export async function confirm(source: Source): Promise<void> {
  const { more, because } = await ask<{ lesson: string }>(source, { do: "ok" });
  if (more) tried.value = null;
  settle(source, more, because, "ok");
}

/** What it does now is not right: time stands until it was said what is. */
export async function object(source: Source): Promise<void> {
  const status = source.status.peek();
  if (status && !status.paused) stopped = (await ask(source, { do: "pause" })).because === "";
}

/** The last lesson is taken back. */
export async function takeBack(source: Source): Promise<void> {
  const { because } = await ask(source, { do: "forget", lesson: learned.peek() });
  if (because) refused.value = { field: "ok", because };
  else learned.value = "";
}

function settle(source: Source, more: { lesson: string } | null, because: string, field: "keep" | "ok"): void {
  refused.value = because ? { field, because } : null;
  if (!more) return;
  learned.value = more.lesson;
  goOn(source);
}

function goOn(source: Source): void {
  if (stopped) void source.send({ do: "resume" });
  stopped = false;
}
