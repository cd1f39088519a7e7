// The live studio's page.

import { render } from "preact";
import { liveAddress, Live } from "./live";
import { App } from "./shell/app";
import { applyTheme } from "./shell/theme";
import "./styles/index.css";

applyTheme();
const source = new Live(liveAddress(new URL(location.href)));
render(<App source={source} />, document.getElementById("app")!);
