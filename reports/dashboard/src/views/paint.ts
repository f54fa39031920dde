// Colours of style.css for a canvas, which knows no variables, and word of a change between light and dark.
// On paper all is light, whatever the page is.
export function painter(): (colour: string) => string {
  const probe = document.createElement("span");
  probe.hidden = true;
  if (printing) probe.style.colorScheme = "light";
  document.body.append(probe);
  const known = new Map<string, string>();
  queueMicrotask(() => probe.remove());
  return (colour) => {
    let paint = known.get(colour);
    if (paint === undefined) {
      probe.style.color = colour;
      paint = getComputedStyle(probe).color;
      known.set(colour, paint);
    }
    return paint;
  };
}

let printing = false;
const papers = new Set<() => void>();
const print = (on: boolean) => () => {
  printing = on;
  for (const draw of papers) draw();
};
window.addEventListener("beforeprint", print(true));
window.addEventListener("afterprint", print(false));

// Calls `draw` when the theme has changed, and before and after printing, as long as the element is in the page.
export function onTheme(element: Element, draw: () => void): void {
  const query = matchMedia("(prefers-color-scheme: dark)");
  const told = () => {
    if (element.isConnected) draw();
    else stop();
  };
  const root = new MutationObserver(told);
  papers.add(told);
  const stop = () => {
    papers.delete(told);
    root.disconnect();
    query.removeEventListener("change", told);
  };
  root.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  query.addEventListener("change", told);
}
