// Colours of style.css for a canvas, which knows no variables, and word of a change between light and dark.
export function painter(): (colour: string) => string {
  const probe = document.createElement("span");
  probe.hidden = true;
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

// Calls `draw` when the theme has changed, as long as the element is in the page.
export function onTheme(element: Element, draw: () => void): void {
  const query = matchMedia("(prefers-color-scheme: dark)");
  const told = () => {
    if (element.isConnected) draw();
    else stop();
  };
  const root = new MutationObserver(told);
  const stop = () => {
    root.disconnect();
    query.removeEventListener("change", told);
  };
  root.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  query.addEventListener("change", told);
}
