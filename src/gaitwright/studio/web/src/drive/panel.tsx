import type { Source } from "../source";

export function DrivePanel({ source }: { source: Source }) {
  return <p class="faint">{source.kind}</p>;
}
