// Plots: which ones, how long, stop and zoom.

import { useMemo } from "preact/hooks";
import type { Source } from "../source";
import { LEGS } from "../ui/colours";
import { Segmented } from "../ui/controls";
import { remembered } from "../ui/remembered";
import { watched } from "../view/settings";
import { ChartView } from "./chart";
import { chartsOf, type GroupId, GROUPS } from "./charts";
import { Feed } from "./feed";
import { held, isHeld, seconds, span, WINDOWS } from "./span";
import { driverBar, stanceBars, Strip } from "./strip";
import "uplot/dist/uPlot.min.css";

const open = remembered<GroupId[]>("plots", ["torques", "forces", "speed"]);

export function PlotsPanel({ source }: { source: Source }) {
  const feed = useMemo(() => new Feed(source), [source]);
  const layout = source.layout.value;
  const robot = source.world.value?.robots[watched.value];
  const drivers = source.hello.value?.choices.drivers;
  const wanted = open.value;
  const charts = useMemo(
    () => (layout && robot ? GROUPS.filter(({ id }) => wanted.includes(id)).flatMap(({ id }) => chartsOf(id, layout, robot)) : []),
    [layout, robot, wanted],
  );
  const bars = useMemo(
    () => (layout && robot ? [...stanceBars(layout, robot.legs), driverBar(layout, drivers ?? [])] : []),
    [layout, robot, drivers],
  );
  if (!layout || !robot) return <p class="faint nothing">no frames yet</p>;
  const toggle = (id: GroupId) => {
    open.value = wanted.includes(id) ? wanted.filter((one) => one !== id) : [...wanted, id];
  };
  return (
    <div class="plots">
      <div class="plots-head">
        <div class="plots-groups">
          {GROUPS.map(({ id, label }) => (
            <button key={id} aria-pressed={wanted.includes(id)} data-testid={`plot-${id}`} onClick={() => toggle(id)}>
              {label}
            </button>
          ))}
        </div>
        <div class="plots-time">
          <Segmented
            id="plot-seconds"
            value={seconds.value}
            choose={(long) => {
              seconds.value = long;
              held.value = null;
              feed.refresh();
            }}
            choices={WINDOWS.map((value) => ({ value, label: `${value} s` }))}
          />
          <button
            data-testid="plot-hold"
            aria-pressed={isHeld.value}
            title="Drag in a plot zooms, a double click goes on"
            onClick={() => {
              const last = source.history(watched.peek())?.last() ?? 0;
              held.value = held.value ? null : span(source.now(), source.kind === "replay", last);
              feed.refresh();
            }}
          >
            {isHeld.value ? "Go on" : "Hold"}
          </button>
          <span class="spring" />
          <span class="legs-key">
            {robot.legs.map((leg, k) => (
              <span key={leg} style={{ "--line-colour": LEGS[k % LEGS.length] }}>
                <i />
                {leg}
              </span>
            ))}
          </span>
        </div>
      </div>
      <Strip id="gait" title="Feet down, and who drives" bars={bars} feed={feed} />
      {charts.map((chart) => (
        <ChartView key={chart.id} chart={chart} feed={feed} />
      ))}
    </div>
  );
}
