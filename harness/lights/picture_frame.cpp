#include "lights/picture_frame.h"

#include "image/canvas.h"
#include "image/font.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

std::vector<std::string> wrapped(const std::vector<std::string>& lines, const Font& font, double width) {
  std::vector<std::string> out;
  for (const auto& line : lines) {
    for (const auto& part : font.wrap(line, width)) out.push_back(part);
  }
  return out;
}

}  // namespace

Bitmap framed(const Bitmap& picture, const std::vector<std::string>& above,
              const std::vector<std::string>& below) {
  const Font font(kPictureText);
  const auto head = wrapped(above, font, picture.width), foot = wrapped(below, font, picture.width);
  const auto lines = static_cast<uint32_t>(head.size() + foot.size());
  Canvas out(picture.width + 2 * kPictureMargin, picture.height + 4 * kPictureMargin + lines * kPictureLine,
             theme().paper);
  uint32_t y = kPictureMargin;
  const auto write = [&](const std::vector<std::string>& text, glm::u8vec3 color) {
    for (const auto& line : text) {
      out.text({kPictureMargin, y}, line, font, {color});
      y += kPictureLine;
    }
    y += kPictureMargin;
  };
  write(head, theme().ink);
  out.picture(kPictureMargin, y, picture);
  y += picture.height + kPictureMargin;
  write(foot, theme().faint);
  return out.bitmap();
}

}  // namespace vsglbench
