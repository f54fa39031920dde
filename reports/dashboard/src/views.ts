// All views, in the order of their tabs.
import type { View } from "./view";
import { casesView } from "./views/cases";
import { historyView } from "./views/history";
import { compareView } from "./views/compare";
import { effectsView } from "./views/effects";
import { stabilityView } from "./views/stability";
import { claimsView } from "./views/claims";

export const views: View[] = [casesView, historyView, compareView, effectsView, stabilityView, claimsView];
