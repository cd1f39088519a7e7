// The middle of the page: the 3-D views.

import type { Source } from "../source";

export function Stage({ source }: { source: Source }) {
  return <div class="stage" data-testid="stage">{source.world.value ? "" : "waiting for the world …"}</div>;
}
