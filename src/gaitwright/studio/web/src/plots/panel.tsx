import type { Source } from "../source";

export function PlotsPanel({ source }: { source: Source }) {
  return <p class="faint">{source.kind}</p>;
}
