// All views, in the order of their tabs.
import type { View } from "./view";
import { casesView } from "./views/cases";
import { imagesView } from "./views/images";

export const views: View[] = [casesView, imagesView];
