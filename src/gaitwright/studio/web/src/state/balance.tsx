// How it stands: margin of stability, attitude, and each leg's load and ground ahead.

import type { Source } from "../source";
import { LEGS } from "../ui/colours";
import { Field, number, Section } from "../ui/controls";
import { watched } from "../view/settings";

const DEGREES = 180 / Math.PI;

export function Balance({ source }: { source: Source }) {
  const scan = source.scan.value;
  const layout = source.layout.value;
  const robot = source.world.value?.robots[watched.value];
  const row = source.latest(watched.value);
  if (!scan || !layout || !robot || !row) return null;
  const [load, stance] = [layout.at("load"), layout.at("stance")];
  const margin = scan.margin;
  return (
    <Section title="Balance">
      <Field label="Margin">
        <span data-testid="margin" class={(margin ?? 0) < 0 ? "negative" : ""}>
          {margin === null ? "no foot down" : `${number(100 * margin, 1)} cm`}
        </span>
      </Field>
      <Field label="Attitude">
        <span>
          roll {number(DEGREES * scan.roll, 1)}°, pitch {number(DEGREES * scan.pitch, 1)}°
        </span>
      </Field>
      <table class="legs" data-testid="legs">
        <thead>
          <tr>
            <th>Leg</th>
            <th>Load N</th>
            <th title="Mean slope of the ground ahead of the foot">Slope °</th>
            <th title="Mean height of the ground ahead of the foot">Height cm</th>
          </tr>
        </thead>
        <tbody>
          {robot.legs.map((leg, k) => (
            <tr key={leg} class={scan.critical[k] ? "critical" : ""} title={scan.critical[k] ? "without it the robot tips" : ""}>
              <td>
                <i class={row[stance + k] > 0.5 ? "foot down" : "foot"} style={{ "--line-colour": LEGS[k % LEGS.length] }} />
                {leg}
              </td>
              <td>{number(row[load + k], 0)}</td>
              <td>{number(scaled(scan.slope[k], DEGREES), 1)}</td>
              <td>{number(scaled(scan.elevation[k], 100), 1)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Section>
  );
}

function scaled(value: number | null | undefined, by: number): number | null {
  return value === null || value === undefined ? null : value * by;
}
