#include "dashboard/pictures.h"

#include <algorithm>
#include <map>
#include <set>

#include "answer/front.h"
#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/png.h"
#include "report/case_names.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kMostNotes = 3;  // of missing files

// Of a report, by the value of a case's images: a file below the report's folder.
bool is_below(const std::string& path) {
  const fs::path normal = fs::path(path).lexically_normal();
  return !path.empty() && normal.is_relative() && *normal.begin() != "..";
}

std::string image_path(const CaseResult& c, const char* key) {
  const auto it = c.images.find(key);
  return it == c.images.end() ? "" : it->second;
}

class Chooser {
 public:
  Chooser(const Report& report, const fs::path& folder, size_t index, const std::vector<int>& groups,
          const PictureOrder& order, double room_mb)
      : report_(report),
        folder_(folder),
        index_(index),
        groups_(groups),
        order_(order),
        room_(room_mb * 1e6) {}

  ChosenPictures choose() {
    std::error_code ec;
    if (!fs::exists(folder_ / "images", ec)) {
      add_kept();
      out_.notes.push_back(
          fmt::format("there is no folder images/ beside the report, hence no picture{} in the page",
                      out_.list.empty() ? "" : " but those of flicker"));
      return std::move(out_);
    }
    const std::set<size_t> exact = exact_cases();
    for (const std::string& glob : order_.cases) {
      const auto matches = [&](const CaseResult& c) { return matches_glob(c.id, glob); };
      if (std::ranges::none_of(report_.cases, matches))
        out_.notes.push_back("no case matches --case " + glob);
    }
    for (const size_t i : exact) add_reference(i);
    for (const size_t i : exact) add_case(i, order_.mode);
    for (size_t i = 0; i < report_.cases.size(); ++i) {
      add_file(i, "profile");
      add_file(i, "flicker");
    }
    for (size_t i = 0; i < report_.cases.size(); ++i) {
      if (exact.contains(i)) continue;
      add_reference(i);
      add_case(i, PictureMode::png);
    }
    if (missing_ > kMostNotes)
      out_.notes.push_back(fmt::format("{} more pictures could not be read", missing_ - kMostNotes));
    return std::move(out_);
  }

 private:
  // The front's cases of every group, and those that are asked for.
  std::set<size_t> exact_cases() const {
    std::set<size_t> out;
    for (const PointGroup& g : point_groups(report_, {order_.metric, "method"})) {
      for (const size_t k : front_of(g)) out.insert(g.points[k].result - report_.cases.data());
    }
    for (size_t i = 0; i < report_.cases.size(); ++i) {
      const auto asked = [&](const std::string& glob) { return matches_glob(report_.cases[i].id, glob); };
      if (std::ranges::any_of(order_.cases, asked)) out.insert(i);
    }
    return out;
  }

  double exposure(const CaseResult& c) const {
    const auto it = std::ranges::find(report_.scenes, c.scene, &SceneReport::name);
    return it == report_.scenes.end() ? 1 : it->exposure;
  }

  int scene(const CaseResult& c) const {
    return static_cast<int>(std::ranges::find(report_.scenes, c.scene, &SceneReport::name) -
                            report_.scenes.begin());
  }

  void add_reference(size_t i) {
    if (groups_[i] < 0 || !references_.insert(groups_[i]).second) return;
    add_image(i, image_path(report_.cases[i], "reference"), "reference", order_.mode);
  }
  void add_case(size_t i, PictureMode mode) {
    add_image(i, image_path(report_.cases[i], "indirect"), "indirect", mode);
  }

  // Anything that can't be read is told, and costs nothing else.
  template <class Add>
  void attempt(const std::string& path, Add add) {
    if (path.empty()) return;
    if (full_) {
      ++out_.left_out;
      return;
    }
    try {
      if (!is_below(path)) throw fail(ErrorKind::config, "{}: is outside of the report's folder", path);
      // A pipe would be waited for.
      if (fs::exists(folder_ / path) && !fs::is_regular_file(folder_ / path))
        throw fail(ErrorKind::output, "{}: is no file", path);
      add(folder_ / path);
    } catch (const std::exception& e) {
      if (missing_++ < kMostNotes) out_.notes.emplace_back(e.what());
    }
  }

  void add_image(size_t i, const std::string& path, const char* kind, PictureMode mode) {
    attempt(path, [&](const fs::path& file) {
      ExrLayers layers = read_exr_layers(file);
      if (!layers.colors.contains("")) throw fail(ErrorKind::output, "{}: lacks R, G and B", file.string());
      const Image& image = layers.colors.at("");
      const auto alpha = layers.scalars.find("A");
      const std::vector<float> coverage =
          alpha == layers.scalars.end() ? std::vector<float>() : alpha->second;
      const bool exr = mode == PictureMode::exr;
      if (exr && embed(i, kind, "exr", image.width, image.height, encode_half_exr(image, coverage))) return;
      const auto factor = static_cast<float>(exposure(report_.cases[i]));
      if (!embed(i, kind, "png", image.width, image.height, encode_png(tone_map(image, factor)))) leave_out();
    });
  }

  // SCENE-METHOD.flicker.png beside a committed report is of the method's first case there, by the picture's
  // name (ci/regenerate-reports).
  void add_kept() {
    std::map<std::string, size_t> first;
    for (size_t i = 0; i < report_.cases.size(); ++i) {
      const CaseResult& c = report_.cases[i];
      const std::string path = image_path(c, "flicker");
      if (path.empty()) continue;
      const auto [at, added] = first.try_emplace(fmt::format("{}-{}.flicker.png", c.scene, c.method), i);
      if (!added && path < image_path(report_.cases[at->second], "flicker")) at->second = i;
    }
    std::error_code ec;
    for (const auto& [name, i] : first) {
      if (fs::exists(folder_ / name, ec)) add_png(i, "flicker", name);
    }
  }

  void add_file(size_t i, const char* kind) { add_png(i, kind, image_path(report_.cases[i], kind)); }

  // A PNG as it is.
  void add_png(size_t i, const char* kind, const std::string& path) {
    attempt(path, [&](const fs::path& file) {
      const Bitmap bitmap = read_png(file);
      if (!embed(i, kind, "png", bitmap.width, bitmap.height, read_text(file))) leave_out();
    });
  }

  bool embed(size_t i, const std::string& kind, const char* format, uint32_t width, uint32_t height,
             const std::string& bytes) {
    const size_t groups = (bytes.size() + 2) / 3;
    const double size = 4.0 * static_cast<double>(groups);
    if (size > room_) return false;
    room_ -= size;
    const CaseResult& c = report_.cases[i];
    Json entry = {{"report", index_},
                  {"scene", scene(c)},
                  {"case", kind == "reference" ? -1 : static_cast<int>(i)},
                  {"group", groups_[i]},
                  {"kind", kind},
                  {"format", format},
                  {"width", width},
                  {"height", height},
                  {"element", fmt::format("image-{}-{}", index_, out_.list.size())}};
    out_.list.push_back({std::move(entry), base64(bytes)});
    return true;
  }

  // What comes later is smaller, if at all, by little: one that finds no room is the last that is tried.
  void leave_out() {
    full_ = true;
    ++out_.left_out;
  }

  const Report& report_;
  const fs::path folder_;
  const size_t index_;
  const std::vector<int>& groups_;
  const PictureOrder& order_;
  double room_;  // bytes of base64
  bool full_ = false;
  size_t missing_ = 0;
  std::set<int> references_;  // of groups
  ChosenPictures out_;
};

}  // namespace

PictureMode picture_mode(const std::string& text) {
  if (text == "none") return PictureMode::none;
  if (text == "png") return PictureMode::png;
  if (text == "exr") return PictureMode::exr;
  throw fail(ErrorKind::usage, "--images {}: there are none, png, exr", text);
}

ChosenPictures choose_pictures(const Report& report, const fs::path& folder, size_t report_index,
                               const std::vector<int>& groups, const PictureOrder& order, double room_mb) {
  if (order.mode == PictureMode::none) return {};
  return Chooser(report, folder, report_index, groups, order, room_mb).choose();
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t have = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < have ? static_cast<uint8_t>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k) out += k <= have ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace vsglbench
