import type { Source } from "../source";

export function StatusPanel({ source }: { source: Source }) {
  return <p class="faint">{source.kind}</p>;
}
