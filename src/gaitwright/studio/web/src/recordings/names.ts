// What is read out of a recording's name, and sizes as people say them.

import { number } from "../ui/controls";

const NAME = /^(\d{4}-\d{2}-\d{2})_(\d{2})-(\d{2})-(\d{2})_(.+?)\.(\w+)$/;

export interface Said {
  day: string;
  time: string;
  what: string;
  kind: string;
}

/** When and of what; of another name all is `what`. */
export function readName(name: string): Said {
  const found = NAME.exec(name);
  if (!found) return { day: "", time: "", what: name, kind: "" };
  const [, day, hours, minutes, seconds, what, kind] = found;
  return { day, time: `${hours}:${minutes}:${seconds}`, what, kind };
}

export interface Form {
  ending: string;
  title: string;
}

const FORMS: Form[] = [
  { ending: "npz", title: "The recording itself: NumPy arrays" },
  { ending: "html", title: "A page that plays it, for every browser" },
  { ending: "mcap", title: "For Foxglove" },
];

/** What a file of a recording can be fetched as. Of the recording itself the server makes other forms, as far
    as it says that it can (`made`; where it says nothing, all of them). */
export function formsOf(name: string, made: string[] | undefined): Form[] {
  const ending = name.split(".").at(-1) ?? "";
  if (ending !== "npz") return [{ ending, title: name }];
  return made ? FORMS.filter((form) => made.includes(form.ending)) : FORMS;
}

/** Of several files of one recording the one itself, else whatever there is; in their order. */
export function once<File extends { name: string }>(files: File[]): File[] {
  const found = new Map<string, File>();
  for (const file of files) {
    const known = found.get(stem(file.name));
    if (!known || file.name.endsWith(".npz")) found.set(stem(file.name), file);
  }
  return [...found.values()];
}

/** A file's name without its ending. */
export function stem(name: string): string {
  return name.replace(/\.\w+$/, "");
}

export function size(bytes: number): string {
  if (bytes < 1e6) return `${number(Math.max(bytes / 1e3, 1), 0)} kB`;
  return bytes < 1e9 ? `${number(bytes / 1e6, bytes < 1e7 ? 1 : 0)} MB` : `${number(bytes / 1e9, 1)} GB`;
}

/** Minutes and seconds. */
export function duration(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/** Where a recording can be fetched: beside the page, with the token of its address. */
export function addressOf(name: string, search: string): string {
  const token = new URLSearchParams(search).get("token");
  return `recordings/${encodeURIComponent(name)}${token ? `?token=${encodeURIComponent(token)}` : ""}`;
}
