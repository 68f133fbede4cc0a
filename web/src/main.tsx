import { render } from "preact";
import { Shell } from "./app/shell";
import "./figures/figures.css";
import "./page.css";

const place = document.getElementById("page");
if (place) render(<Shell />, place);
