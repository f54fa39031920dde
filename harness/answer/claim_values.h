// What a claim's metric is of a case: a value a seed, or a time.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "answer/point.h"

namespace vsglbench {

bool is_time(const std::string& metric);  // "time:generate", "time:pass:generate.rsm.sum*"
// "generate.rsm.sum*" of the second; nothing of other metrics.
std::optional<std::string> pass_glob(const std::string& metric);
// ms that such a metric is of; nothing where the case has no such time.
std::optional<Summary> claimed_time(const CaseResult& c, const std::string& metric);
// Relative; of the A/A pair's time that it is part of, and 0 where that is not known. Of what is no time,
// that of the method, by which equal times are told.
double claimed_noise(const Report& report, const std::string& scene, const std::string& metric);
bool is_temporal(const std::string& metric);  // "temporal.static"

// By seed. Of temporal.static, of a seed's distances to others. Of what is counted, and may be 0, with half a
// unit more: of spikes half a pixel, of kernel_over half a light, of how the lights lie half a texel. Of
// other metrics a seed without a value above 0 is left out.
std::map<uint64_t, double> logs_of(const CaseResult& c, const std::string& metric);

// Of what is counted: 0 in every seed.
bool has_none(const CaseResult& c, const std::string& metric);

}  // namespace vsglbench
