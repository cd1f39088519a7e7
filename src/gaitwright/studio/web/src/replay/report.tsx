// The figures of a recording.

import type { Source } from "../source";
import { number } from "../ui/controls";
import { Player } from "./player";

export function Report({ source }: { source: Source }) {
  if (!(source instanceof Player)) return null;
  const entries = Object.entries(source.story.value.report ?? {});
  if (!entries.length) return <p class="faint nothing">no figures came with it</p>;
  return (
    <table class="report" data-testid="report">
      <tbody>
        {entries.map(([name, value]) => (
          <tr key={name}>
            <th>{name.replaceAll("_", " ")}</th>
            <td>{inWords(value)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function inWords(value: unknown): string {
  if (typeof value === "number") return Number.isInteger(value) ? number(value, 0) : number(value, 3);
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (value === null || value === undefined) return "–";
  if (Array.isArray(value)) return value.map(inWords).join(", ");
  if (typeof value === "object") {
    return Object.entries(value).map(([name, one]) => `${name} ${inWords(one)}`).join(", ");
  }
  return String(value);
}
