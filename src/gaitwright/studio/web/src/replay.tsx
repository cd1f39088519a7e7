// A replay page: the same views and plots, from the recording in the page.

import { render } from "preact";
import { embedded, noRecording } from "./replay/embedded";
import { Player } from "./replay/player";
import { ReplayApp } from "./replay/app";
import { clock } from "./replay/clock";
import { applyTheme } from "./shell/theme";
import "./styles/index.css";

applyTheme();
const place = document.getElementById("app")!;
const found = embedded(document);
if (typeof found === "string") render(noRecording(found), place);
else {
  document.title = found.title || document.title;
  void Player.of(found, clock).then((player) => {
    clock.play();
    render(<ReplayApp first={player} />, place);
  });
}
