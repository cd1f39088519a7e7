// Frames, their history, and rows between them.

import { expect, test } from "vitest";
import { Blend } from "../src/blend";
import { HEADER, parseFrame } from "../src/frame";
import { History } from "../src/history";
import { Layout } from "../src/layout";

const COLUMNS = [
  { name: "time", size: 1 },
  { name: "orientation_wb", size: 4 },
  { name: "stance", size: 1 },
];

function frame(rows: number[][]): ArrayBuffer {
  const width = rows[0].length;
  const data = new ArrayBuffer(HEADER + rows.length * width * 4);
  const view = new DataView(data);
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setUint16(2, rows.length, true);
  view.setUint32(4, 77, true);
  view.setFloat64(8, 1234.5, true);
  rows.flat().forEach((value, k) => view.setFloat32(HEADER + 4 * k, value, true));
  return data;
}

test("a frame is read by its columns", () => {
  const layout = new Layout(COLUMNS);
  const read = parseFrame(frame([[1, 1, 0, 0, 0, 1], [2, 0, 1, 0, 0, 0]]), layout.width)!;
  expect([read.paused, read.sequence, read.sent, read.rows.length]).toEqual([true, 77, 1234.5, 2]);
  expect([...layout.get(read.rows[1], "orientation_wb")]).toEqual([0, 1, 0, 0]);
  expect(layout.get(read.rows[0], "stance")[0]).toBe(1);
});

test("what is too short, or of another kind, is no frame", () => {
  const whole = frame([[1, 1, 0, 0, 0, 1]]);
  expect(parseFrame(whole.slice(0, whole.byteLength - 1), 6)).toBeNull();
  expect(parseFrame(new ArrayBuffer(3), 6)).toBeNull();
  new DataView(whole).setUint8(0, 9);
  expect(parseFrame(whole, 6)).toBeNull();
});

test("a history keeps the last seconds and starts anew where time goes back", () => {
  const history = new History(1, 0, 10, 50);
  for (let k = 0; k <= 200; k++) history.add(new Float32Array([k]));
  expect(history.count).toBe(11);
  expect([history.time(0), history.last()]).toEqual([190, 200]);
  expect(history.time(history.from(195))).toBe(195);
  history.add(new Float32Array([3]));
  expect([history.count, history.last()]).toEqual([1, 3]);
});

test("a full ring drops the oldest", () => {
  const history = new History(1, 0, Infinity, 4);
  for (let k = 0; k < 9; k++) history.add(new Float32Array([k]));
  expect([0, 1, 2, 3].map((k) => history.time(k))).toEqual([5, 6, 7, 8]);
});

test("between two rows: unit quaternions along the shorter arc, feet down or not", () => {
  const layout = new Layout(COLUMNS);
  const out = new Float32Array(layout.width);
  const half = Math.SQRT1_2;
  const before = new Float32Array([0, 1, 0, 0, 0, 0]);
  const after = new Float32Array([1, -half, 0, 0, -half, 1]); // a quarter turn left, with the other sign
  new Blend(layout).into(out, before, after, 0.5);
  const turn = layout.get(out, "orientation_wb");
  expect(2 * Math.atan2(turn[3], turn[0])).toBeCloseTo(Math.PI / 4, 5);
  expect(Math.hypot(...turn)).toBeCloseTo(1, 6);
  new Blend(layout).into(out, before, after, 0.4);
  expect(layout.get(out, "stance")[0]).toBe(0);
});
