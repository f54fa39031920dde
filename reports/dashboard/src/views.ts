// All views, in the order of their tabs.
import type { View } from "./view";
import { budgetView } from "./views/budget";
import { casesView } from "./views/cases";
import { convergenceView } from "./views/convergence";
import { flickerView } from "./views/flicker";
import { frontView } from "./views/front";
import { imagesView } from "./views/images";
import { knobsView } from "./views/knobs";
import { passesView } from "./views/passes";

export const views: View[] = [
  frontView, passesView, budgetView, knobsView, convergenceView, imagesView, flickerView, casesView,
];
