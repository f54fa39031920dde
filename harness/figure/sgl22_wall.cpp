// [SGL22] Fig. 1: a diffuse wall that a small light stands close to, so that all but its foot is lit at
// grazing angles. The light is a VSGL that shines alike in all directions: at a distance d it is an SG of
// sharpness κ = d²/σ² [MFIS16 Eq. 11], and a white wall reflects I/(2πσ²) A(κ) L(v·n,κ)/π.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figure/sgl22.h"
#include "image/contact.h"
#include "operation/sg_evaluation.h"

namespace vsglbench::sgl22 {
namespace {

using std::numbers::pi;

struct Wall {
  uint32_t width, height;
  double extent, light_height, sigma;

  // v·n and κ at the wall's point (x,y), the light's foot at (0,0).
  void append(double x, double y, std::vector<float>* rows) const {
    const double distance2 = x * x + y * y + light_height * light_height;
    rows->push_back(static_cast<float>(light_height / std::sqrt(distance2)));
    rows->push_back(static_cast<float>(distance2 / (sigma * sigma)));
  }
  float radiance(float sharpness, double clamped_cosine) const {
    return static_cast<float>(exact::sg_integral(sharpness) * clamped_cosine / (2 * pi * pi * sigma * sigma));
  }
};

std::vector<float> pixel_rows(const Wall& wall) {
  const double pixel = wall.extent / wall.width;
  std::vector<float> rows;
  for (uint32_t j = 0; j < wall.height; ++j) {
    for (uint32_t i = 0; i < wall.width; ++i) {
      wall.append((i + 0.5 - 0.5 * wall.width) * pixel, (j + 0.5 - 0.5 * wall.height) * pixel, &rows);
    }
  }
  return rows;
}

// From the light's foot to the wall's edge, by ratio.
std::vector<double> profile_distances(const Wall& wall) {
  const double least = wall.light_height / 10, most = wall.extent / 2;
  std::vector<double> out;
  for (int i = 0; i <= 200; ++i) out.push_back(least * std::pow(most / least, i / 200.0));
  return out;
}

template <class Values>
Image image_of(const Wall& wall, const std::vector<float>& rows, const Values& values) {
  Image image(wall.width, wall.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = glm::vec3(wall.radiance(rows[2 * i + 1], values[i]));
  }
  return image;
}

double largest_difference(const std::vector<float>& values, const std::vector<double>& exact) {
  double most = 0;
  for (size_t i = 0; i < exact.size(); ++i) most = std::max(most, std::abs(values[i] - exact[i]));
  return most;
}

Plot profile_plot(const Wall& wall) {
  return {.title = "A light close to a wall: error of diffuse lighting",
          .x = {"distance from the light's foot / m", true},
          .y = {"error / % of exact"},
          .notes = {fmt::format(
              "Light {} m above the wall, σ = {} m. Single precision on the GPU against quadrature.",
              wall.light_height, wall.sigma)}};
}

std::vector<Claim> claims_of(const std::vector<double>& smape) {
  using enum exact::DiffuseModel;
  const auto of = [&](exact::DiffuseModel model) { return smape[static_cast<size_t>(model)]; };
  const double ours = of(tokuyoshi2022), hill = of(pettineo_hill), meder = of(meder_bruederlin);
  return {
      {"at grazing angles the method's SMAPE is smaller than those of Pettineo and Hill, and of Meder and "
       "Brüderlin",
       "[SGL22] Fig. 1", finding(ours < std::min(hill, meder)),
       fmt::format("SMAPE {:.3g} % against {:.3g} % and {:.3g} %", ours, hill, meder)}};
}

}  // namespace

FigureOutput wall(const FigureInputs& inputs) {
  const Json& c = inputs.config;
  const Wall wall{c["width"], c["height"], c["extent"], c["light_height"], c["light_sigma"]};
  const std::vector<float> rows = pixel_rows(wall);
  const std::vector<double> distances = profile_distances(wall);
  std::vector<float> profile_rows;
  for (const double x : distances) wall.append(x, 0, &profile_rows);

  FigureOutput out;
  FigureTable table{
      "sgl22-1", {"model", "origin", "smape_percent", "bias_percent", "max_abs_error_of_L"}, {}};
  FigureTable profile{
      "sgl22-1-profile", {"model", "origin", "distance_m", "cosine", "sharpness", "L", "exact_L"}, {}};
  Plot plot = profile_plot(wall);
  ModelImages images;
  std::vector<double> smape, exact_pixels, exact_profile;
  for (size_t k = 0; k < kModels; ++k) {
    const auto model = static_cast<exact::DiffuseModel>(k);
    SgEvaluator evaluator(inputs.device, {SgFunction::clamped_cosine, model});
    inputs.begin(fmt::format("the wall of {}×{} pixels, {}", wall.width, wall.height, name(model)));
    // The quadrature is the same for all.
    if (k == 0) {
      exact_pixels = evaluator.evaluate(rows).exact;
      exact_profile = evaluator.evaluate(profile_rows).exact;
      images.reference = image_of(wall, rows, exact_pixels);
    }
    const std::vector<float> pixels = evaluator.values(rows), along = evaluator.values(profile_rows);
    images.images.push_back(image_of(wall, rows, pixels));
    const Errors errors = measure_errors(images.images.back(), images.reference);
    smape.push_back(errors.smape);
    table.add(name(model), std::string("measured"), errors.smape, 100 * errors.bias.value_or(0),
              largest_difference(pixels, exact_pixels));
    Curve curve{name(model), {}};
    for (size_t i = 0; i < distances.size(); ++i) {
      profile.add(name(model), std::string("measured"), distances[i], profile_rows[2 * i],
                  profile_rows[2 * i + 1], along[i], exact_profile[i]);
      curve.points.push_back({distances[i], 100 * (along[i] / exact_profile[i] - 1)});
    }
    plot.curves.push_back(std::move(curve));
  }
  out.tables = {table, profile};
  out.plots = {{"sgl22-1", plot}};
  add_picture(&out, "sgl22-1", images, "A sharp SG light close to a wall", "quadrature, double precision");
  out.claims = claims_of(smape);
  return out;
}

void add_picture(FigureOutput* figure, const std::string& name, const ModelImages& models,
                 const std::string& title, const std::string& reference_detail,
                 const std::vector<std::string>& more) {
  ContactSheet sheet;
  sheet.title = title;
  sheet.reference_detail = reference_detail;
  sheet.reference = models.reference;
  sheet.mask = models.mask;
  sheet.exposure = auto_exposure(models.reference, models.mask);
  sheet.error_range = 0.2f;
  for (size_t k = 0; k < models.images.size(); ++k) {
    const Errors errors = measure_errors(models.images[k], models.reference, models.mask);
    const std::string detail = fmt::format("SMAPE {:.3g} %   RMSE {:.3g}{}", errors.smape, errors.rmse,
                                           more.empty() ? "" : "\n" + more.at(k));
    sheet.entries.push_back({exact::diffuse_model_names()[k], detail, models.images[k], std::nullopt});
  }
  const auto pages = contact_pages(sheet);
  for (size_t i = 0; i < pages.size(); ++i)
    figure->images.emplace_back(page_name(name, i, pages.size()), pages[i]);
}

}  // namespace vsglbench::sgl22
