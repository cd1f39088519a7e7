// The shell: a bar above, docks left and right, the views between them, a bar below.

import { useMemo } from "preact/hooks";
import { tools } from "../drive/hand";
import { useHands } from "../drive/panel";
import { useMap } from "../map/panel";
import { panels } from "../panels";
import type { Source } from "../source";
import { Shown } from "../teach/shown";
import { useOwnRun } from "../teach/teaching";
import { Stage } from "../view/stage";
import { BottomBar } from "./bottom-bar";
import { Dock } from "./dock";
import { Notice } from "./notice";
import { TopBar } from "./top-bar";
import { dockWidth } from "./docks";

export function App({ source }: { source: Source }) {
  useHands(source);
  useMap(source);
  useOwnRun(source);
  const hands = useMemo(() => tools(source), [source]);
  const style = { "--left": `${dockWidth("left")}px`, "--right": `${dockWidth("right")}px` };
  return (
    <div class="app" style={style} data-testid="app">
      <TopBar source={source} />
      <Dock side="left" panels={panels} source={source} />
      <main class="middle">
        <Stage source={source} tools={hands} />
        <Notice source={source} />
        <Shown source={source} />
      </main>
      <Dock side="right" panels={panels} source={source} />
      <BottomBar source={source} />
    </div>
  );
}
