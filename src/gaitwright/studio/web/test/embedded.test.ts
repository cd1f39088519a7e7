import { expect, test } from "vitest";
import { clock } from "../src/replay/clock";
import { playerOf, read } from "../src/replay/embedded";

const NAMES = [
  "time", "position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "tau", "load", "stance",
  "forces_w", "command", "driver", "power",
];
const WHOLE = {
  title: "go2 in maze", world: "x", columns: NAMES.map((name) => ({ name, size: 1 })), drivers: [], rate: 50, count: 2,
  rows: "x", events: [{ time: 0, skill: "trot", driver: "numerical", because: "", rule: "" }], report: {},
};

function page(text: string): Document {
  return { getElementById: () => ({ textContent: text }) } as unknown as Document;
}

test("a whole recording is read", () => {
  expect(read(JSON.stringify(WHOLE))).toEqual(WHOLE);
});

test.each([
  ["events", undefined], ["events", [{ skill: "trot" }]], ["drivers", "numerical"], ["world", 3], ["title", null],
  ["columns", [null]], ["columns", WHOLE.columns.slice(1)], ["rows", undefined], ["movers", [{ time: 0 }]], ["others", [{ title: "x" }]],
])("a recording with %s %j says that it lacks them", (name, what) => {
  const found = read(JSON.stringify({ ...WHOLE, [name]: what }));
  expect(found).toBe(`The recording in this page lacks a part: ${name}.`);
});

test("what is no recording says so, and so does one whose packed parts are damaged", async () => {
  expect(await playerOf(page(""), clock)).toBe("This replay page has no recording in it.");
  for (const text of ["{", "null", "[]", "7"]) expect(read(text)).toMatch(/damaged|lacks/);
  expect(await playerOf(page(JSON.stringify(WHOLE)), clock)).toBe("The recording in this page is damaged.");
});

test("the clock ends where what is shown ends", () => {
  clock.lasts(20);
  clock.seek(15);
  clock.lasts(5);
  expect([clock.time.value, clock.duration.value]).toEqual([5, 5]);
  clock.lasts(20);
  expect(clock.time.value).toBe(5);
});
