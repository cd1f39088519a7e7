import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { held, Steering } from "../src/drive/steering";
import { Noted } from "./sources";

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("window", globalThis);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const FORWARD = { forward: 1, left: 0, turn: 0 };
const NOTHING = { do: "steer", forward: 0, left: 0, turn: 0 };

test("what is held is told twenty times a second, and zero when it is let go", () => {
  const page = new Noted();
  const steering = new Steering(page.source);
  steering.hold("keys", FORWARD);
  vi.advanceTimersByTime(1000);
  expect(page.told.length).toBe(21);
  steering.hold("keys", null);
  expect(page.told.at(-1)).toEqual(NOTHING);
  vi.advanceTimersByTime(1000);
  expect(page.told.length).toBe(22);
});

test("who loses the wheel has let go, and is not heard any more", () => {
  const page = new Noted();
  const steering = new Steering(page.source);
  steering.hold("keys", FORWARD);
  steering.hold("stick", FORWARD);
  const before = page.told.length;
  page.drives(false);
  expect(held.value).toBeNull();
  steering.hold("stick", FORWARD);
  steering.hold("stick", null);
  vi.advanceTimersByTime(1000);
  expect(page.told.length).toBe(before);
  page.drives(true);
  vi.advanceTimersByTime(1000);
  expect(page.told.length).toBe(before); // it does not go on by itself
  steering.hold("keys", FORWARD);
  expect(page.told.length).toBe(before + 1);
});
