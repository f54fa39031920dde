// All views, in the order of their tabs.
import type { View } from "./view";
import { budgetView } from "./views/budget";
import { casesView } from "./views/cases";
import { claimsView } from "./views/claims";
import { compareView } from "./views/compare";
import { convergenceView } from "./views/convergence";
import { effectsView } from "./views/effects";
import { flickerView } from "./views/flicker";
import { frontView } from "./views/front";
import { historyView } from "./views/history";
import { imagesView } from "./views/images";
import { knobsView } from "./views/knobs";
import { passesView } from "./views/passes";
import { stabilityView } from "./views/stability";

export const views: View[] = [
  frontView,
  passesView,
  budgetView,
  knobsView,
  convergenceView,
  imagesView,
  flickerView,
  historyView,
  compareView,
  effectsView,
  stabilityView,
  claimsView,
  casesView,
];
