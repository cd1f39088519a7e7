// Over the views: that there is no connection, that the run is over or says nothing, and what to do about it.

import { drives, type Source } from "../source";
import { Icon } from "../ui/icons";

export function Notice({ source }: { source: Source }) {
  const lost = source.lost.value;
  const bad = lost || source.closed.value || source.silent.value;
  const text = bad || source.status.value?.over;
  if (!text) return null;
  return (
    <div class={`notice ${bad ? "bad" : ""}`} role="alert" data-testid="notice">
      <p>{text}</p>
      {!lost &&
        (drives(source) ? (
          <button class="primary icon-text" data-testid="begin-again" onClick={() => void source.send({ do: "reset" })}>
            <Icon name="reset" />
            Reset
          </button>
        ) : (
          <p class="faint">Who drives can reset it.</p>
        ))}
    </div>
  );
}
