#include "image/theme.h"

#include <algorithm>
#include <stdexcept>

namespace vsglbench {
namespace {

// Errors stand out from a correct image's near-black by their lightness, of both signs by hue.
constexpr Theme kDark{{22, 23, 27},
                      {32, 33, 39},
                      {238, 238, 240},
                      {172, 175, 184},
                      {70, 70, 74},
                      {{{190, 232, 255},
                        {72, 150, 236},
                        {26, 66, 142},
                        {14, 14, 18},
                        {140, 36, 30},
                        {240, 110, 40},
                        {255, 232, 150}}}};

// Errors stand out from white by their darkness.
constexpr Theme kLight{{255, 255, 255},
                       {240, 240, 243},
                       {16, 16, 20},
                       {76, 78, 86},
                       {196, 196, 200},
                       {{{10, 40, 110},
                         {40, 110, 180},
                         {150, 195, 225},
                         {250, 250, 250},
                         {245, 185, 140},
                         {205, 85, 50},
                         {100, 10, 25}}}};

constexpr const Theme* kThemes[] = {&kDark, &kLight};
const Theme* current = &kDark;

}  // namespace

const std::vector<std::string>& theme_names() {
  static const std::vector<std::string> names = {"dark", "light"};
  return names;
}

void set_theme(std::string_view name) {
  const auto at = std::ranges::find(theme_names(), name);
  if (at == theme_names().end()) throw std::invalid_argument("no such theme");
  current = kThemes[at - theme_names().begin()];
}

const Theme& theme() { return *current; }

}  // namespace vsglbench
