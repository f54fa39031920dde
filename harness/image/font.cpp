#include "image/font.h"

#include <cairo-ft.h>
#include <fontconfig/fontconfig.h>

#include "base/error.h"
#include "base/json.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

constexpr const char* kFamily = "DejaVu Sans";

using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

// What fontconfig has under that name, and not the next best.
Pattern find_font() {
  const Pattern wanted(FcPatternCreate(), FcPatternDestroy);
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(kFamily));
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  Pattern found(FcFontMatch(nullptr, wanted.get(), &result), FcPatternDestroy);
  FcChar8* family = nullptr;
  if (!found || FcPatternGetString(found.get(), FC_FAMILY, 0, &family) != FcResultMatch ||
      reinterpret_cast<const char*>(family) != std::string_view(kFamily)) {
    throw fail(ErrorKind::output, "the font {} is not installed; install the package fonts-dejavu-core",
               kFamily);
  }
  return found;
}

cairo_font_face_t* face() {
  static cairo_font_face_t* const found = cairo_ft_font_face_create_for_pattern(find_font().get());
  return found;
}

// Text as its signs; the text is UTF-8.
std::vector<std::string_view> signs(std::string_view text) {
  std::vector<std::string_view> out;
  for (size_t at = 0, end = 0; at < text.size(); at = end) {
    for (end = at + 1; end < text.size() && (text[end] & 0xC0) == 0x80;) ++end;
    out.push_back(text.substr(at, end - at));
  }
  return out;
}

}  // namespace

std::string drawable(std::string_view text) {
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return printable(Json::parse(quoted).get<std::string>());
}

Font::Font(double size) {
  cairo_matrix_t scale, identity;
  cairo_matrix_init_scale(&scale, size, size);
  cairo_matrix_init_identity(&identity);
  cairo_font_face_t* const known =
      face();  // before anything is to be freed: it throws where there is no font
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_ON);
  scaled_ = {cairo_scaled_font_create(known, &scale, &identity, options), cairo_scaled_font_destroy};
  cairo_font_options_destroy(options);
}

double Font::width(std::string_view text) const { return advance(drawable(text)); }

double Font::advance(const std::string& drawable) const {
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(scaled_.get(), drawable.c_str(), &extents);
  return extents.x_advance;
}

double Font::ascent() const {
  cairo_font_extents_t extents;
  cairo_scaled_font_extents(scaled_.get(), &extents);
  return extents.ascent;
}

std::string Font::fit(std::string_view text, double width) const {
  std::string whole = drawable(text), out;
  if (advance(whole) <= width) return whole;
  double used = advance("…");
  for (const std::string_view sign : signs(whole)) {
    used += advance(std::string(sign));
    if (used > width) break;
    out += sign;
  }
  return out + "…";
}

std::vector<std::string> Font::wrap(std::string_view text, double width) const {
  const std::string whole = drawable(text);
  std::vector<std::string> lines(1);
  double used = 0;
  size_t last_space = std::string::npos;  // in the current line
  for (const std::string_view sign : signs(whole)) {
    const double width_of_sign = advance(std::string(sign));
    if (!lines.back().empty() && used + width_of_sign > width) {
      std::string rest;
      if (sign != " " && last_space != std::string::npos) {
        rest = lines.back().substr(last_space + 1);
        lines.back().resize(last_space);
      }
      used = advance(rest);
      lines.push_back(std::move(rest));
      last_space = std::string::npos;
      if (sign == " ") continue;
    }
    if (sign == " ") last_space = lines.back().size();
    lines.back() += sign;
    used += width_of_sign;
  }
  return lines;
}

}  // namespace vsglbench
