#include "run/scene_pdfs.h"

#include <algorithm>

#include "method/registry.h"
#include "run/pdf_source.h"

namespace vsglbench {
namespace {

// Pyramid of an RSM's texels (shaders/pyramid.glsl): means over the texels that each texel of a level covers.
std::vector<float> pyramid_of(const std::vector<float>& base, uint32_t side) {
  std::vector<float> out = base;
  std::vector<double> sums(base.begin(), base.end());  // over those texels
  uint32_t below = side;
  for (uint32_t level = 1; below > 1; ++level) {
    const uint32_t size = (below + 1) / 2;
    std::vector<double> next(size_t(size) * size, 0);
    for (uint32_t y = 0; y < below; ++y) {
      for (uint32_t x = 0; x < below; ++x) next[size_t(y / 2) * size + x / 2] += sums[size_t(y) * below + x];
    }
    const auto covered = [&](uint32_t t) {
      return static_cast<double>(std::min(side, (t + 1) << level) - (t << level));
    };
    for (uint32_t y = 0; y < size; ++y) {
      for (uint32_t x = 0; x < size; ++x)
        out.push_back(static_cast<float>(next[size_t(y) * size + x] / (covered(x) * covered(y))));
    }
    sums = std::move(next);
    below = size;
  }
  return out;
}

}  // namespace

const KeptPdfs& ScenePdfs::get(const Case& c) {
  const FrameParameters& p = c.frame;
  const std::string maker = p.pdf == "own" ? c.method + c.method_parameters.dump() : "";
  const std::tuple key{p.width, p.height, p.rsm, p.importance_lights, p.pdf, maker};
  const auto known = made_.find(key);
  return known != made_.end() ? known->second : made_.emplace(key, make(c)).first->second;
}

KeptPdfs ScenePdfs::make(const Case& c) const {
  const PdfSource source = pdf_source(c.frame.pdf);
  if (source.kind == PdfSource::Kind::own) return made_by(c.method, c.method_parameters, c.frame);
  const std::string maker =
      source.kind == PdfSource::Kind::method ? source.name : find_importance_maker(LightKind::vsgl).name;
  KeptPdfs pdfs = made_by(maker, Json::object(), c.frame);
  // The G-buffer's is the same whoever makes the RSM's.
  if (source.kind == PdfSource::Kind::flux) {
    FrameParameters by_flux = c.frame;
    by_flux.importance = Importance::flux;
    pdfs.rsm = made_by(maker, Json::object(), by_flux).rsm;
  }
  if (source.kind == PdfSource::Kind::image) pdfs.rsm = from_image(source.name, c.frame.rsm);
  return pdfs;
}

KeptPdfs ScenePdfs::made_by(const std::string& method, const Json& parameters, FrameParameters frame) const {
  frame.lights = 1;  // makes no difference to the PDFs
  frame.visibility = Visibility::none;
  const MethodInfo& info = load_method(method, stage_.device.info());
  return Frame(stage_, info, resolve_parameters(info, parameters), frame, nullptr).prepare(0);
}

Buffer ScenePdfs::from_image(const std::string& path, uint32_t side) const {
  const std::vector<float> pyramid = pyramid_of(read_pdf_image(path, side), side);
  Buffer kept(stage_.device, "kept pdf.rsm", pyramid.size() * sizeof(float));
  kept.upload(std::span<const float>(pyramid));
  return kept;
}

}  // namespace vsglbench
