// A replay page: the same views and plots, from the recording in the page.

import { render } from "preact";
import { noRecording, playerOf } from "./replay/embedded";
import { ReplayApp } from "./replay/app";
import { clock } from "./replay/clock";
import { applyTheme } from "./shell/theme";
import "./styles/index.css";

applyTheme();
const place = document.getElementById("app")!;
void playerOf(document, clock).then((found) => {
  if (typeof found === "string") {
    render(noRecording(found), place);
    return;
  }
  document.title = found.recording.title || document.title;
  clock.play();
  render(<ReplayApp first={found} />, place);
});
