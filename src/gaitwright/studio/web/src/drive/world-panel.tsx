import type { Source } from "../source";

export function WorldPanel({ source }: { source: Source }) {
  return <p class="faint">{source.kind}</p>;
}
