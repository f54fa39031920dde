// All views, in the order of their tabs.
import type { View } from "./view";
import { casesView } from "./views/cases";
import { flickerView } from "./views/flicker";
import { frontView } from "./views/front";
import { imagesView } from "./views/images";

export const views: View[] = [frontView, casesView, imagesView, flickerView];
