// The colours of what the programme draws: one theme for screens, dark, and one for print, light.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vsglbench {

struct Theme {
  glm::u8vec3 paper, panel, ink, faint;  // behind all, behind text tiles, text, lesser text
  glm::u8vec3 no_surface;                // in error maps
  std::array<glm::vec3, 7> errors;       // sRGB, 0 to 255, from -1 to 1 in even steps
};

const std::vector<std::string>& theme_names();
// For all pictures of this process and those it forks; dark at first. Throws std::invalid_argument for a name
// that is none of theme_names().
void set_theme(std::string_view name);
const Theme& theme();

}  // namespace vsglbench
