// Draws with WebGL2: pictures are float textures, read pixel by pixel.
import type { Picture } from "./picture";
import { INFERNO, NO_SURFACE, NOT_FINITE, SIGNED, texels } from "./ramps";
import { type Box, type Camera, type Divider, type Layer, type Look, type Pane, type Renderer, STOPS, toScreen } from "./scene";
import { FRAGMENT, KINDS, VERTEX } from "./shader";

const MOST_TEXTURES = 12;

export class WebGlRenderer implements Renderer {
  readonly canvas = document.createElement("canvas");
  private gl: WebGL2RenderingContext;
  private program: WebGLProgram;
  private places = new Map<string, WebGLUniformLocation | null>();
  private textures = new Map<Picture, WebGLTexture>(); // those used last at the end

  // Throws where there is no WebGL2.
  constructor(onLost: () => void) {
    // What is drawn is kept for printing.
    const gl = this.canvas.getContext("webgl2", { antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.program = this.link();
    gl.useProgram(this.program);
    this.setUp();
    this.canvas.addEventListener("webglcontextlost", onLost);
  }

  draw(panes: Pane[], camera: Camera, look: Look, divider: Divider): void {
    const gl = this.gl;
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0); // beside the pictures the stage is seen
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.uniform1f(this.at("exposure"), look.exposure);
    gl.uniform1f(this.at("range"), look.range);
    for (const pane of panes) if (pane.layers.length > 0) this.drawPane(pane, camera, divider);
    this.forget();
  }

  private drawPane(pane: Pane, camera: Camera, divider: Divider): void {
    const gl = this.gl;
    const ratio = window.devicePixelRatio;
    const { width, height } = pane.layers[0].x;
    const bottom = this.canvas.height;
    const [left, top] = toScreen(pane.box, camera, 0, 0);
    gl.scissor(
      Math.round(pane.box.x * ratio),
      Math.round(bottom - (pane.box.y + pane.box.height) * ratio),
      Math.round(pane.box.width * ratio),
      Math.round(pane.box.height * ratio),
    );
    gl.uniform2i(this.at("size"), width, height);
    gl.uniform2f(this.at("origin"), left * ratio, bottom - top * ratio);
    gl.uniform1f(this.at("zoom"), camera.zoom * ratio);
    const second = pane.layers[1] ?? pane.layers[0];
    gl.uniform2i(this.at("kinds"), KINDS[pane.layers[0].kind], KINDS[second.kind]);
    this.setLine(pane.layers.length > 1 ? pane.box : null, divider, ratio);
    this.bind(pane.layers[0], 0);
    this.bind(second, 2);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // The divider in device pixels, y upwards; without a box everything is on its first side.
  private setLine(box: Box | null, divider: Divider, ratio: number): void {
    if (!box) return this.gl.uniform3f(this.at("line"), 0, 0, 1);
    const angle = (divider.angle * Math.PI) / 180;
    const [nx, ny] = [Math.cos(angle), -Math.sin(angle)];
    const x = (box.x + divider.x * box.width) * ratio;
    const y = this.canvas.height - (box.y + divider.y * box.height) * ratio;
    this.gl.uniform3f(this.at("line"), nx, ny, nx * x + ny * y);
  }

  private bind(layer: Layer, unit: number): void {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, this.texture(layer.x));
    gl.activeTexture(gl.TEXTURE0 + unit + 1);
    gl.bindTexture(gl.TEXTURE_2D, this.texture(layer.r ?? layer.x));
  }

  private texture(picture: Picture): WebGLTexture {
    const gl = this.gl;
    let texture = this.textures.get(picture);
    if (texture) this.textures.delete(picture);
    else {
      texture = this.makeTexture();
      const { width, height, values, png } = picture;
      if (values) gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, values);
      else if (png) gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, png);
    }
    this.textures.set(picture, texture);
    return texture;
  }

  private makeTexture(): WebGLTexture {
    const gl = this.gl;
    const texture = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
  }

  private forget(): void {
    for (const [picture, texture] of this.textures) {
      if (this.textures.size <= MOST_TEXTURES) break;
      this.gl.deleteTexture(texture);
      this.textures.delete(picture);
    }
  }

  private at(name: string): WebGLUniformLocation | null {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name)!;
  }

  // What never changes: the units of the textures, ramps and flat colours.
  private setUp(): void {
    const gl = this.gl;
    ["x0", "r0", "x1", "r1", "ramps"].forEach((name, unit) => gl.uniform1i(this.at(name), unit));
    gl.activeTexture(gl.TEXTURE4);
    this.makeTexture();
    const both = new Uint8Array([...texels(INFERNO), ...texels(SIGNED)]);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 2, 0, gl.RGBA, gl.UNSIGNED_BYTE, both);
    gl.uniform2f(this.at("stops"), STOPS.low, STOPS.high);
    for (const [name, c] of [["noSurface", NO_SURFACE], ["notFinite", NOT_FINITE]] as const)
      gl.uniform3f(this.at(name), c[0] / 255, c[1] / 255, c[2] / 255);
  }

  private link(): WebGLProgram {
    const gl = this.gl;
    const program = gl.createProgram()!;
    for (const [type, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const logs = (gl.getAttachedShaders(program) ?? []).map((s) => gl.getShaderInfoLog(s));
      throw new Error(`the viewer's shader: ${gl.getProgramInfoLog(program)} ${logs.join(" ")}`);
    }
    return program;
  }
}
