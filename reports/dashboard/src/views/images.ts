// Reference, two methods and their error maps, under one camera.
import "../viewer/stage.css";
import { groupIndex } from "../choice";
import { h } from "../dom";
import type { Page, View } from "../view";
import { listen } from "../viewer/gestures";
import type { Kind, Layer, Look } from "../viewer/scene";
import { Stage } from "../viewer/stage";
import { type Actions, controls, keysHelp } from "./image_controls";
import { choose, type Chosen, decode, type Decoded, isScenePicture, type Shot, shotsOf } from "./image_choice";
import { legends, readout, statisticsTable } from "./image_figures";
import { onHandleKey, onKey } from "./image_keys";
import { inside, readSettings, type Settings, writeSettings } from "./image_settings";

// One WebGL context for as long as the page stands.
let stage: Stage | null = null;
let current: ImageView | null = null;

class ImageView {
  private top = h("div");
  private below = h("div");
  private reading = h("div");
  private beside = h("div");
  private legend = h("div", { class: "legends" });
  private settings: Settings;
  private shots: Shot[] = [];
  private waiting = 0;
  private actions: Actions;

  constructor(private page: Page, private chosen: Chosen, private decoded: Decoded, private stage: Stage) {
    this.settings = readSettings(page.state);
    this.settings.rectangle = inside(this.settings.rectangle, decoded.size);
    this.actions = { change: (c) => this.change(c), zoom: (f) => this.zoom(f), toPixels: () => this.toPixels() };
  }

  attach(root: HTMLElement): void {
    const notes = [...this.decoded.failures, this.stage.fallback].filter((n) => n !== "");
    root.replaceChildren(this.top, ...notes.map((n) => h("p", { class: "warning" }, n)), this.stage.root, this.beside, this.below, keysHelp());
    this.stage.camera = this.settings.camera;
    this.stage.arranged = () => (this.stage.spare.hidden ? this.beside : this.stage.spare).replaceChildren(this.reading, this.legend);
    this.update();
    root.dataset.ready = "yes";
  }

  get size(): [number, number] {
    return this.decoded.size;
  }
  get drawing(): boolean {
    return this.settings.tool;
  }

  key(e: KeyboardEvent): void {
    if (onKey(e, { settings: this.settings, shots: this.shots, size: this.size }, this.stage, this.actions)) e.preventDefault();
  }
  handleKey(e: KeyboardEvent): void {
    if (!onHandleKey(e, this.stage, (c) => this.change(c))) return;
    e.preventDefault();
    e.stopPropagation();
  }

  // After a gesture.
  moved(): void {
    const { camera, divider, rectangle } = this.stage;
    this.change({ camera, divider, rectangle });
  }
  // While one goes on: the figures alone, once a frame.
  hovered(): void {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      this.reading.replaceChildren(readout(this.shots, this.stage.pixel));
      if (this.stage.rectangle !== this.settings.rectangle) this.showStatistics();
    });
  }

  private change(changes: Partial<Settings>): void {
    this.settings = { ...this.settings, ...changes };
    writeSettings(this.page.state, this.settings);
    this.update();
  }

  private zoom(factor: number): void {
    if (factor === 0) this.stage.camera = null;
    else this.stage.zoomTo(this.stage.view().zoom * factor);
    this.change({ camera: this.stage.camera });
  }
  private toPixels(): void {
    this.stage.zoomTo(1 / window.devicePixelRatio);
    this.change({ camera: this.stage.camera });
  }

  private look(): Look {
    const { report } = this.page;
    const scene = report.groups[groupIndex(this.page)]?.scene ?? this.chosen.a?.scene ?? 0;
    return { exposure: (report.scenes[scene]?.exposure ?? 1) * 2 ** this.settings.stops, range: this.settings.range };
  }

  private update(): void {
    const s = this.settings;
    this.shots = shotsOf(this.page, this.chosen, this.decoded, s.falseColour, s.error);
    if (!this.shots.some((shot) => shot.id === s.left)) s.left = "r";
    if (!this.shots.some((shot) => shot.id === s.right)) s.right = this.shots[1]?.id ?? "r";
    Object.assign(this.stage, { look: this.look(), divider: s.divider, rectangle: s.rectangle });
    this.showPanes();
    this.showControls();
    this.reading.replaceChildren(readout(this.shots, this.stage.pixel));
    this.showStatistics();
    this.stage.redraw();
  }

  private showPanes(): void {
    const s = this.settings;
    const of = (id: string) => this.shots.find((shot) => shot.id === id)!;
    const groups = s.layout === "all" ? this.shots.map((shot) => [shot]) : s.layout === "one" || s.left === s.right ? [[of(s.left)]] : [[of(s.left), of(s.right)]];
    this.stage.show(
      groups.map((shots) => ({
        titles: shots.map((shot) => shot.title),
        layers: shots.every((shot) => shot.layer) ? shots.map((shot) => shot.layer as Layer) : [],
        note: shots.map((shot) => shot.note).filter((n) => n !== "").join(" "),
      })),
      this.decoded.size,
    );
    const words = groups.map((shots) => shots.map((shot) => shot.title).join(" beside ")).join("; ");
    this.stage.root.setAttribute("aria-label", `Pictures: ${words}. Exposure ${s.stops} stops over the scene's.`);
  }

  private showControls(): void {
    const focused = document.activeElement?.id;
    const dragged = document.activeElement instanceof HTMLInputElement && document.activeElement.type === "range" ? document.activeElement : null;
    const fresh = controls(this.page, this.chosen, this.shots, this.settings, this.actions);
    if (dragged && this.top.contains(dragged)) return this.keepSlider(dragged, fresh);
    this.top.replaceChildren(...fresh);
    if (focused && document.activeElement?.id !== focused) document.getElementById(focused)?.focus({ preventScroll: true });
  }

  // A slider that is being dragged stays the same element, or the drag would end.
  private keepSlider(slider: HTMLInputElement, fresh: HTMLElement[]): void {
    const words = slider.parentElement!.querySelector("output")!;
    const holder = fresh.flatMap((row) => [...row.querySelectorAll("output")])[0];
    words.textContent = holder.textContent;
    slider.setAttribute("aria-valuetext", holder.textContent ?? "");
    slider.parentElement!.querySelector("button")!.disabled = this.settings.stops === 0;
    if (Number(slider.value) !== this.settings.stops) slider.value = String(this.settings.stops);
  }

  private showStatistics(): void {
    const kinds = new Set<Kind>(this.stage.panes.flatMap((pane) => pane.layers.map((layer) => layer.kind)));
    this.legend.replaceChildren(...legends(kinds, this.stage.look));
    this.below.replaceChildren(statisticsTable(this.page, this.chosen, this.decoded, this.stage.rectangle));
  }
}

function makeStage(): Stage {
  const made = new Stage();
  made.root.setAttribute("role", "group");
  for (const [element, label, lo, hi] of [[made.handle, "Divider", 0, 100], [made.knob, "Angle of the divider", -180, 180]] as const) {
    element.type = "button";
    for (const [key, value] of Object.entries({ role: "slider", "aria-label": label, "aria-valuemin": lo, "aria-valuemax": hi, "aria-valuenow": 0 })) element.setAttribute(key, String(value));
    element.addEventListener("keydown", (e) => current?.handleKey(e));
  }
  listen(made, () => current?.size ?? [1, 1], { drawing: () => current?.drawing ?? false, changed: () => current?.moved(), hovered: () => current?.hovered() });
  return made;
}

// Whether a key is meant for the element that has the focus.
const isTaken = (e: KeyboardEvent) => e.target instanceof HTMLElement && (e.target.closest("select, input, textarea, .table") !== null || (e.target instanceof HTMLButtonElement && e.key === "Enter"));

export const imagesView: View = {
  id: "images",
  title: "Images",
  filters: ["group"],
  has: ({ digest }) => digest.images.some(isScenePicture),
  draw(root, page) {
    const chosen = choose(page);
    if (!chosen.a && !chosen.reference) {
      current = null;
      const places = [...new Set(page.digest.images.filter(isScenePicture).map((i) => page.digest.reports[i.report].scenes[i.scene].name))];
      root.append(h("p", {}, `The page has no picture of this scene and visibility. It has some of ${places.join(", ")}.`));
      return;
    }
    const body = h("div", { id: "im-body" }, h("p", { class: "note" }, "Pictures are being decoded."));
    body.addEventListener("keydown", (e) => !isTaken(e) && current?.key(e));
    root.append(body);
    stage ??= makeStage();
    const shown = stage;
    void decode(page.digest, chosen).then((decoded) => {
      if (!body.isConnected) return;
      current = new ImageView(page, chosen, decoded, shown);
      current.attach(body);
    });
  },
};
