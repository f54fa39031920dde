// All views, in the order of their tabs.
import type { View } from "./view";
import { casesView } from "./views/cases";
import { frontView } from "./views/front";

export const views: View[] = [frontView, casesView];
