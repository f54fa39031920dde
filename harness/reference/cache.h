// References on disk: <cache>/references/<hash>.exr and .json.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "reference/reference.h"

namespace vsglbench {

// The cached reference of `hash`; nothing where there is none or, after a warning, where its files are
// damaged or of another size.
std::optional<ReferenceResult> cached_reference(const std::string& hash,
                                                const ReferenceParameters& parameters);

// The cached reference of `hash` (reference_hash), or a new one, which is then stored. A file that is
// damaged, truncated or of another size is computed anew; a cache that can't be written is a warning.
// `from_cache`, if given, says which it was.
ReferenceResult load_or_compute(const Scene& scene, const ReferenceParameters& parameters,
                                bool* from_cache = nullptr);
// The same of any reference of `scene`: the cached one of `hash`, or compute()'s.
ReferenceResult load_or_compute(const Scene& scene, const std::string& hash,
                                const ReferenceParameters& parameters,
                                const std::function<ReferenceResult()>& compute, bool* from_cache = nullptr);

}  // namespace vsglbench
