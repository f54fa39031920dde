// All views, in the order of their tabs.
import type { View } from "./view";
import { casesView } from "./views/cases";

export const views: View[] = [casesView];
