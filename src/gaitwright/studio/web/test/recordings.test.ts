import { expect, test } from "vitest";
import { addressOf, duration, formsOf, once, readName, size, stem } from "../src/recordings/names";

test("a recording's name tells when and of what", () => {
  expect(readName("2026-01-02_03-04-05_go2_2.npz")).toEqual({
    day: "2026-01-02", time: "03:04:05", what: "go2_2", kind: "npz",
  });
  expect(readName("mine.npz").what).toBe("mine.npz");
});

test("sizes and times are as people say them", () => {
  expect([10, 5.4e4, 3.21e6, 4.2e7, 2e9].map(size)).toEqual(["1 kB", "54 kB", "3.2 MB", "42 MB", "2.0 GB"]);
  expect([0, 9.9, 61, 600].map(duration)).toEqual(["0:00", "0:09", "1:01", "10:00"]);
});

test("it is fetched with the token of the page's address and nothing else of it", () => {
  expect(addressOf("a b.npz", "?token=x%26y&z=1")).toBe("recordings/a%20b.npz?token=x%26y");
  expect(addressOf("a.npz", "")).toBe("recordings/a.npz");
});

test("several files of one recording are one", () => {
  const files = ["b.html", "b.npz", "a.npz", "c.mcap"].map((name) => ({ name }));
  expect(once(files).map(({ name }) => name)).toEqual(["b.npz", "a.npz", "c.mcap"]);
  expect(stem("2026-01-02_03-04-05_go2.npz")).toBe("2026-01-02_03-04-05_go2");
});

test("a recording is offered in the forms that the studio can make", () => {
  const endings = (name: string, made?: string[]) => formsOf(name, made).map(({ ending }) => ending);
  expect(endings("a.npz")).toEqual(["npz", "html", "mcap"]);
  expect(endings("a.npz", ["npz", "html"])).toEqual(["npz", "html"]);
  expect(endings("a.mcap", ["npz", "html"])).toEqual(["mcap"]);
});
