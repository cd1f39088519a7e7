// Plays a recording: the page that the server makes of it, in a tab of its own.

import { addressOf, stem } from "./names";

export function openReplay(name: string): void {
  window.open(addressOf(`${stem(name)}.html`, location.search), "_blank", "noopener");
}
