// What was learned at obstacles: terrain operators, in the order in which they are tried; those in use are lit.

import type { Source } from "../source";
import { number, Section } from "../ui/controls";

export function Operators({ source }: { source: Source }) {
  const operators = source.curve.value?.operators ?? [];
  const used = source.status.value?.operators_in_use ?? [];
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
