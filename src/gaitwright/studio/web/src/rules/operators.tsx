// What was learned at obstacles: terrain operators, in the order in which they are tried; those in use are lit.

import { useRef } from "preact/hooks";
import type { Status } from "../protocol";
import type { Source } from "../source";
import { number, Section } from "../ui/controls";

/** A swing is short: what a leg did stands there a little longer [s of the run]. */
const STAYS = 1.5;

type Used = NonNullable<Status["operators_in_use"]>[number];

export function Operators({ source }: { source: Source }) {
  const operators = source.curve.value?.operators ?? [];
  const used = useOfLate(source.status.value);
  const untaught = used.filter(({ name }) => !name);
  return (
    <Section title="Over obstacles" aside={operators.length ? `${operators.length}, the first that fits is taken` : ""}>
      {!operators.length && (
        <p class="faint about" data-testid="no-operators">
          Nothing was taught yet: under “Curves”, edit a foot’s path with something ahead of it.
        </p>
      )}
      <ol class="rules" data-testid="operators">
        {operators.map(({ name, kinds, largest, strategy, taught, sentence }) => {
          const now = used.filter((one) => one.name === name);
          const size = kinds.join() === "slope" ? number(largest) : `${number(100 * largest, 1)} cm`;
          return (
            <li
              key={name}
              class={`rule-row operator ${now.length ? "lit" : ""}`}
              data-testid="terrain-operator"
              data-operator={name}
              data-legs={now.map(({ leg }) => leg).join(" ")}
            >
              <p title={sentence}>
                <strong>{name}</strong> <span class="faint">{strategy}</span>
                <span class="operator-legs">
                  {now.map(({ leg }) => (
                    <b key={leg}>{leg}</b>
                  ))}
                </span>
              </p>
              <p class="faint">
                {kinds.join(", ")} of up to {size} · taught {taught}
              </p>
              {now.map(({ leg, because }) => (
                <p key={leg} data-testid="operator-because">
                  {because}
                </p>
              ))}
            </li>
          );
        })}
      </ol>
      {untaught.map(({ leg, because }) => (
        <p key={leg} class="faint about">
          {because}
        </p>
      ))}
    </Section>
  );
}

/** What legs did until a moment ago. */
function useOfLate(status: Status | null): Used[] {
  const known = useRef(new Map<string, { used: Used; time: number }>());
  const time = status?.time ?? 0;
  for (const used of status?.operators_in_use ?? []) known.current.set(used.leg, { used, time });
  for (const [leg, one] of known.current) {
    if (time - one.time > STAYS || time < one.time) known.current.delete(leg);
  }
  return [...known.current.values()].map(({ used }) => used);
}
