// DejaVu Sans, found through fontconfig; sizes are in pixels.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct _cairo_scaled_font;

namespace vsglbench {

// The font at one size, without kerning: a text is as wide as its signs together. Text is UTF-8; control
// characters become spaces, and what is no UTF-8 the sign U+FFFD. Throws Error(output) where the font is not
// installed.
class Font {
 public:
  explicit Font(double size);

  double width(std::string_view text) const;
  double ascent() const;
  // The text, or its beginning and "…", so that it is at most `width` pixels wide.
  std::string fit(std::string_view text, double width) const;
  // Broken at spaces into lines of at most `width` pixels, longer words anywhere.
  std::vector<std::string> wrap(std::string_view text, double width) const;

  _cairo_scaled_font* scaled() const { return scaled_.get(); }

 private:
  double advance(const std::string& drawable) const;
  std::shared_ptr<_cairo_scaled_font> scaled_;
};

// Text as the font takes it.
std::string drawable(std::string_view text);

}  // namespace vsglbench
