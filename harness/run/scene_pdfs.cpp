#include "run/scene_pdfs.h"

#include "method/registry.h"

namespace vsglbench {

const KeptPdfs& ScenePdfs::get(const FrameParameters& parameters) {
  const std::tuple key{parameters.width, parameters.height, parameters.rsm, parameters.importance_lights};
  const auto known = made_.find(key);
  if (known != made_.end()) return known->second;
  FrameParameters p = parameters;
  p.lights = 1;  // makes no difference to the PDFs
  p.visibility = Visibility::none;
  const MethodInfo& maker = load_method(ScenePdfs::maker().name, stage_.device.info());
  Frame frame(stage_, maker, resolve_parameters(maker, Json::object()), p, nullptr);
  return made_.emplace(key, frame.prepare(0)).first->second;
}

}  // namespace vsglbench
