// Tokuyoshi 2022, "Accurate Diffuse Lighting from Spherical Gaussian Lights" [SGL22], figure by figure.
#pragma once

#include "figure/figure.h"
#include "image/image.h"
#include "image/metrics.h"
#include "shaders/sg_exact.h"

namespace vsglbench::sgl22 {

// The diffuse models, in the order of exact::diffuse_model_names().
constexpr size_t kModels = 5;
inline const std::string& name(exact::DiffuseModel model) {
  return exact::diffuse_model_names()[static_cast<size_t>(model)];
}

// Fig. 1: a sharp SG light close to a wall. Config: width, height (of the wall), extent (of the wall's width,
// m), light_height (m above it), light_sigma (m).
FigureOutput wall(const FigureInputs& inputs);
// Fig. 2: SG approximations of the clamped cosine minus itself. Config: steps, width, height.
FigureOutput clamped_cosine(const FigureInputs& inputs);
// Fig. 3: RMSE of the normalised hemispherical integral over sharpness. Config: least, most, steps, cosines,
// width, height.
FigureOutput hemisphere(const FigureInputs& inputs);
// Fig. 4: a frame lit by few VSGLs: time, black splotches, error. Config: scene, method, N, parameters, rsm,
// width, height, image, repetitions, splotch.
FigureOutput lights(const FigureInputs& inputs);

// As the config's width and height have it; without them the plot's own.
inline void set_size(const Json& config, Plot* plot) {
  plot->width = config.value("width", plot->width);
  plot->height = config.value("height", plot->height);
}

// The pictures of all models beside the reference's, as pages of a contact sheet.
struct ModelImages {
  Image reference;
  Mask mask;
  std::vector<Image> images;  // one a model
};
// Above each, SMAPE and RMSE, and `more` of that model, such as its time.
void add_picture(FigureOutput* figure, const std::string& name, const ModelImages& models,
                 const std::string& title, const std::string& reference_detail,
                 const std::vector<std::string>& more = {});

}  // namespace vsglbench::sgl22
