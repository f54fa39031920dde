// What a reader has chosen, in the URL's fragment: "#v=front&g=2&m=rmse". A key that is not there has its
// default, so that the fragment stays short; what a view does not know it leaves alone.

// Keys that all views share:
//   v  view              g  index of Report.groups    m  metric       t  time
//   x  methods hidden, by name, with commas           c  indices of selected cases, with commas
//   r  index in Digest.reports; the last where it is not given             d  dark or light
// Keys of one view begin with its id's first two letters: "im.exposure".
export class State {
  private values = new URLSearchParams();
  private listeners: (() => void)[] = [];

  constructor() {
    this.read();
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) === this.text()) return;
      this.read();
      this.tell();
    });
  }

  get(key: string, otherwise = ""): string {
    return this.values.get(key) ?? otherwise;
  }
  number(key: string, otherwise: number): number {
    const v = Number(this.values.get(key) ?? NaN);
    return Number.isFinite(v) ? v : otherwise;
  }
  list(key: string): string[] {
    return this.get(key).split(",").filter((s) => s !== "");
  }

  // An empty value takes the key away. `quietly`: the view has shown the change itself, and nothing is drawn anew.
  set(changes: Record<string, string | number>, quietly = false): void {
    for (const [key, value] of Object.entries(changes)) {
      if (value === "") this.values.delete(key);
      else this.values.set(key, String(value));
    }
    history.replaceState(null, "", "#" + this.text());
    if (!quietly) this.tell();
  }
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  text(): string {
    return this.values.toString().replaceAll("%2C", ",").replaceAll("%3A", ":").replaceAll("%2F", "/");
  }
  private read(): void {
    this.values = new URLSearchParams(location.hash.slice(1));
  }
  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
