#include "run/pdf_source.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/nearest.h"
#include "base/printable.h"
#include "image/exr.h"
#include "image/png.h"
#include "method/registry.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

bool is_image(const std::string& text) { return text.ends_with(".exr") || text.ends_with(".png"); }

// Its lights can make an importance: it draws them by a PDF. A refused one can't even be asked.
bool can_make_pdfs(const MethodInfo& method) { return method.refused.empty() && method.takes_light_count; }

std::vector<std::string> known_sources() {
  std::vector<std::string> names = {"own", "flux"};
  for (const MethodInfo* method : all_methods()) {
    if (can_make_pdfs(*method)) names.push_back(method->name);
  }
  return names;
}

// IEC 61966-2-1.
double decode_srgb(uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double luminance_of(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<double> luminance;
};

Picture read_exr_picture(const fs::path& path) {
  const Image image = read_exr(path);
  Picture out{image.width, image.height, {}};
  for (const glm::vec3& c : image.pixels) out.luminance.push_back(luminance_of(c.r, c.g, c.b));
  return out;
}

Picture read_png_picture(const fs::path& path) {
  const Bitmap bitmap = read_png(path);
  Picture out{bitmap.width, bitmap.height, {}};
  for (uint32_t y = 0; y < bitmap.height; ++y) {
    for (uint32_t x = 0; x < bitmap.width; ++x) {
      const uint8_t* rgb = bitmap.at(x, y);
      out.luminance.push_back(luminance_of(decode_srgb(rgb[0]), decode_srgb(rgb[1]), decode_srgb(rgb[2])));
    }
  }
  return out;
}

Picture read_picture(const fs::path& path) {
  try {
    return path.extension() == ".png" ? read_png_picture(path) : read_exr_picture(path);
  } catch (const Error& e) {
    throw fail(ErrorKind::config, "pdf: {}", printable(e.what()));
  }
}

void check(const Picture& picture, const fs::path& path) {
  for (size_t i = 0; i < picture.luminance.size(); ++i) {
    const double v = picture.luminance[i];
    if (std::isfinite(v) && v >= 0) continue;
    throw fail(ErrorKind::config,
               "pdf: {}: pixel ({}, {}) has the luminance {}; a PDF is finite and not below 0",
               printable(path.string()), i % picture.width, i / picture.width, v);
  }
  if (std::ranges::none_of(picture.luminance, [](double v) { return v > 0; }))
    throw fail(ErrorKind::config, "pdf: {}: is black: no light can be drawn by it", printable(path.string()));
}

// The pixels that a texel takes on one axis, and their weights, whose sum is 1.
struct Span {
  uint32_t first = 0;
  std::vector<double> weights;
};

Span span_of(uint64_t texel, uint64_t texels, uint64_t pixels) {
  if (pixels < texels) return {static_cast<uint32_t>((2 * texel + 1) * pixels / (2 * texels)), {1}};
  // In units in which a pixel is `texels` wide, and a texel `pixels`.
  const uint64_t from = texel * pixels, to = from + pixels;
  Span span{static_cast<uint32_t>(from / texels), {}};
  for (uint64_t p = span.first; p * texels < to; ++p) {
    const uint64_t shared = std::min(to, (p + 1) * texels) - std::max(from, p * texels);
    span.weights.push_back(static_cast<double>(shared) / static_cast<double>(pixels));
  }
  return span;
}

std::vector<Span> spans_of(uint32_t texels, uint32_t pixels) {
  std::vector<Span> out;
  for (uint32_t t = 0; t < texels; ++t) out.push_back(span_of(t, texels, pixels));
  return out;
}

std::vector<double> resized(const Picture& picture, uint32_t side) {
  const auto columns = spans_of(side, picture.width), rows = spans_of(side, picture.height);
  std::vector<double> out;
  for (const Span& row : rows) {
    for (const Span& column : columns) {
      double sum = 0;
      for (size_t y = 0; y < row.weights.size(); ++y) {
        const double* line = &picture.luminance[(row.first + y) * picture.width + column.first];
        for (size_t x = 0; x < column.weights.size(); ++x)
          sum += row.weights[y] * column.weights[x] * line[x];
      }
      out.push_back(sum);
    }
  }
  return out;
}

std::string maker_in_words(const std::string& text) {
  const PdfSource source = pdf_source(text);
  switch (source.kind) {
    case PdfSource::Kind::own:
      return "each method's own lights";
    case PdfSource::Kind::flux:
      return "the power that each texel reflects";
    case PdfSource::Kind::method:
      return source.name;
    case PdfSource::Kind::image:
      return "the image " + source.name;
  }
  throw std::logic_error("no such source of a PDF");
}

}  // namespace

PdfSource pdf_source(const std::string& text) {
  if (text == "own") return {PdfSource::Kind::own, ""};
  if (text == "flux") return {PdfSource::Kind::flux, ""};
  if (is_image(text)) {
    std::error_code ec;
    if (fs::is_regular_file(text, ec)) return {PdfSource::Kind::image, text};
    throw fail(ErrorKind::config, "no PDF '{}': there is no such file, from where the command runs",
               printable(text));
  }
  const auto& all = all_methods();
  const auto at = std::ranges::find(all, text, &MethodInfo::name);
  if (at == all.end()) {
    if (text.find_first_of("/.") != std::string::npos)
      throw fail(ErrorKind::config, "no PDF '{}': an image's path ends in .exr or .png", printable(text));
    throw fail(ErrorKind::config, "no PDF '{}'{}", printable(text), suggestion(text, known_sources()));
  }
  if (!(*at)->refused.empty())
    throw fail(ErrorKind::config, "no PDF '{}': {}", text, printable((*at)->refused));
  if (!can_make_pdfs(**at)) {
    throw fail(ErrorKind::config, "no PDF '{}': {} draws no lights that could make one; known: {}", text,
               text, fmt::join(known_sources(), ", "));
  }
  return {PdfSource::Kind::method, text};
}

std::vector<float> read_pdf_image(const fs::path& path, uint32_t side) {
  const Picture picture = read_picture(path);
  check(picture, path);
  const std::vector<double> texels = resized(picture, side);
  const double largest = *std::ranges::max_element(texels);
  std::vector<float> out;
  for (const double v : texels) out.push_back(static_cast<float>(v / largest));
  return out;
}

Json describe_pdfs(const std::vector<Case>& cases) {
  std::vector<std::string> makers;
  Json images = Json::object();
  for (const Case& c : cases) {
    if (!c.parameters.contains("pdf")) continue;
    const std::string maker = maker_in_words(c.frame.pdf);
    if (std::ranges::find(makers, maker) != makers.end()) continue;
    makers.push_back(maker);
    if (pdf_source(c.frame.pdf).kind != PdfSource::Kind::image) continue;
    read_pdf_image(c.frame.pdf, 1);
    const std::vector<uint8_t> bytes = read_bytes(c.frame.pdf);
    images[c.frame.pdf] = Hasher().bytes(bytes.data(), bytes.size()).hex();
  }
  if (makers.empty()) makers.push_back(FrameParameters().pdf);  // of the halves that no case draws by
  Json out = {{"pdfs_made_by", fmt::format("{}", fmt::join(makers, "; "))}};
  if (!images.empty()) out["pdf_images"] = std::move(images);
  return out;
}

}  // namespace vsglbench
