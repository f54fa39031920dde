// A line of text that filters a view: what is typed is taken 200 ms after the last key.
import { h } from "../dom";

export function filterBox(label: string, id: string, value: string, change: (value: string) => void): HTMLElement {
  let waiting = 0;
  const input = h("input", { type: "search", id, value });
  input.addEventListener("input", () => {
    clearTimeout(waiting);
    waiting = window.setTimeout(() => change(input.value), 200);
  });
  return h("label", { class: "choice", for: id }, h("span", {}, label), input);
}

// Whether a text holds all words, in any case of letters.
export function holdsAll(text: string, words: string): boolean {
  const low = text.toLowerCase();
  return words.toLowerCase().split(/\s+/).every((w) => w === "" || low.includes(w));
}
