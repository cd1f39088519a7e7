import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { type Now, watchOver } from "../src/rules/why";
import { Noted } from "./sources";

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("document", { hidden: false });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test("a rule that is looked at is asked about briefly, once a second, while it is looked at", async () => {
  const page = new Noted();
  const now: Now = { situation: { slope: "0 to 5" }, fires: "trot" };
  page.answer = { done: true, more: { ...now } };
  const heard: Now[] = [];
  const stop = watchOver(page.source, "trot", (one) => heard.push(one));
  await vi.advanceTimersByTimeAsync(2100);
  expect(page.asked).toEqual(Array(3).fill({ do: "why", rule: "trot", brief: true }));
  expect(heard).toEqual([now, now, now]);
  stop();
  await vi.advanceTimersByTimeAsync(3000);
  expect(page.asked.length).toBe(3);
});

test("nothing is asked without a connection, nor a second time before there is an answer", async () => {
  const page = new Noted();
  page.link.value = "lost";
  const stop = watchOver(page.source, "trot", () => {});
  await vi.advanceTimersByTimeAsync(2000);
  expect(page.asked.length).toBe(0);
  page.link.value = "open";
  page.send = (command) => (page.asked.push(command), new Promise(() => {}));
  await vi.advanceTimersByTimeAsync(5000);
  expect(page.asked.length).toBe(1);
  stop();
});
