#include "run/code_size.h"

#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "gpu/recorder.h"
#include "method/filtered_sampling.h"
#include "method/registry.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// What every method is written against, and no method's own.
const std::set<std::string> kContract = {"method.h",   "plugin.h",     "context.h",      "context.cpp",
                                         "registry.h", "light_kind.h", "light_kind.cpp", "types.h"};

// Dispatches that generating from a half of this size takes. Recorded only: what the half holds plays no
// part.
unsigned count_dispatches(Device& device, Method& method, Half half, uint32_t width, uint32_t height,
                          uint32_t lights) {
  std::array<DeviceImage, 5> maps;
  Field field;
  field.half = half;
  field.emitter.width = width;
  field.emitter.height = height;
  for (DeviceImage& map : maps) {
    map = DeviceImage(device, "map", VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  }
  field.maps = {&maps[0], &maps[1], &maps[2], &maps[3], &maps[4]};
  const Buffer pdf(device, "pdf", pyramid_texels(width, height) * sizeof(float));
  field.pdf = method.uses_importance() ? &pdf : nullptr;
  const uint32_t count = method.light_count(lights, field.texels());
  // Nothing is written: as much of it as a device takes will do.
  const uint64_t bytes = count * light_stride(method.kind());
  const Buffer target(device, "lights", std::min<uint64_t>(bytes, device.info().max_storage_range));
  Recorder recorder(device);
  recorder.begin();
  Steps steps(recorder, half);
  method.generate(steps, field, {&target, count, glm::uvec2(0)});
  return recorder.dispatches();
}

bool is_source(const fs::path& path) {
  const auto e = path.extension();
  return e == ".cpp" || e == ".h" || e == ".comp" || e == ".glsl";
}

std::set<fs::path> own_files(const MethodInfo& method) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::canonical(method.folder))) {
    const bool test = entry.path().stem().string().ends_with("_test");
    if (is_source(entry.path()) && !test) files.insert(entry.path());
  }
  return files;
}

size_t lines_of(const std::set<fs::path>& files) {
  size_t lines = 0;
  for (const auto& file : files) lines += count_lines(read_text(file));
  return lines;
}

}  // namespace

size_t count_lines(const std::string& text) {
  size_t lines = 0;
  bool code = false, block = false, quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (c == '\n') {
      lines += code;
      code = quoted = false;
    } else if (block) {
      block = !(c == '*' && next == '/');
      i += !block;
    } else if (!quoted && c == '/' && next == '*') {
      block = true;
      ++i;
    } else if (!quoted && c == '/' && next == '/') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else {
      if (c == '"' && !(i > 0 && text[i - 1] == '\\')) quoted = !quoted;
      code = code || !std::isspace(static_cast<unsigned char>(c));
    }
  }
  return lines + code;
}

namespace {

// What a text includes by #include "NAME".
std::vector<std::string> included(const std::string& text) {
  constexpr std::string_view kDirective = "#include \"";
  std::vector<std::string> out;
  for (size_t at = 0; (at = text.find(kDirective, at)) != std::string::npos;) {
    at += kDirective.size();
    const size_t end = text.find_first_of("\"\n", at);
    if (end != std::string::npos && text[end] == '"' && end > at) out.push_back(text.substr(at, end - at));
  }
  return out;
}

}  // namespace

std::set<fs::path> include_closure(const fs::path& file, const std::vector<fs::path>& include_dirs) {
  std::set<fs::path> found;
  std::vector<fs::path> left = {file};
  std::error_code ec;
  while (!left.empty()) {
    const fs::path next = fs::weakly_canonical(left.back());
    left.pop_back();
    if (!fs::is_regular_file(next, ec) || !found.insert(next).second) continue;
    if (next.extension() == ".h") left.push_back(fs::path(next).replace_extension(".cpp"));
    const std::string text = read_text(next);
    for (const std::string& name : included(text)) {
      std::vector<fs::path> dirs = {next.parent_path()};
      dirs.insert(dirs.end(), include_dirs.begin(), include_dirs.end());
      for (const auto& dir : dirs) {
        if (!fs::is_regular_file(dir / name, ec)) continue;
        left.push_back(dir / name);
        break;
      }
    }
  }
  return found;
}

CodeSize code_size(Device& device, const std::string& name) {
  const MethodInfo& info = load_method(name, device.info());
  const fs::path harness = data_root() / "harness";
  if (!fs::exists(harness / "method" / "context.cpp")) {
    throw fail(ErrorKind::config,
               "{}: holds no host sources to count; run code-size from a built source tree",
               data_root().string());
  }
  KernelLibrary kernels(device);
  ScratchPool scratch(device);
  MethodContext context(kernels, scratch, info.folder);
  const auto method = info.create(context, resolve_parameters(info, Json::object()));
  CodeSize size;
  size.method = name;
  size.published = info.published_code_size;
  size.gbuffer_dispatches = count_dispatches(device, *method, Half::gbuffer, 1920, 1088, 2048);
  scratch.clear();
  size.rsm_dispatches = count_dispatches(device, *method, Half::rsm, 512, 512, 1024);
  size.kernels = context.kernels().size();

  // Host code and kernels of its own, and what they include: of the rooms method and shaders, but for the
  // contract.
  const std::set<fs::path> own = own_files(info);
  std::set<fs::path> roots = own, shared;
  roots.insert(context.kernel_files().begin(), context.kernel_files().end());
  std::vector<fs::path> dirs = KernelLibrary::include_dirs();
  dirs.push_back(harness);
  for (const auto& root : roots) {
    for (const auto& file : include_closure(root, dirs)) {
      const std::string at = fs::relative(file, fs::canonical(harness)).string();
      const bool counted = at.starts_with("method/") || at.starts_with("shaders/");
      if (counted && !kContract.contains(file.filename())) shared.insert(file);
    }
  }
  for (const auto& file : own) size.own_files.insert(file.filename());
  for (const auto& file : shared) size.shared_files.insert(fs::relative(file, fs::canonical(harness)));
  size.own_lines = lines_of(own);
  size.shared_lines = lines_of(shared);
  return size;
}

std::string code_size_table(const std::vector<CodeSize>& sizes) {
  std::string out =
      fmt::format("{:<20} {:>8} {:>12} {:>12} {:>10} {:>12}   {}\n", "", "kernels", "dispatches",
                  "dispatches", "own lines", "shared lines", "published: shaders, dispatches, lines");
  out += fmt::format("{:<20} {:>8} {:>12} {:>12}\n", "", "", "G-buffer", "RSM");
  for (const auto& s : sizes) {
    const std::string row = s.published ? fmt::format("{}, {}, {}", s.published->shaders,
                                                      s.published->dispatches, s.published->lines)
                                        : "-";
    out += fmt::format("{:<20} {:>8} {:>12} {:>12} {:>10} {:>12}   {}\n", s.method, s.kernels,
                       s.gbuffer_dispatches, s.rsm_dispatches, s.own_lines, s.shared_lines, row);
  }
  out +=
      "Lines of C++ and GLSL without blanks and comments; shared: what the method includes of harness/method "
      "and "
      "harness/shaders,\nwhich other methods include too. Dispatches at 1920x1088, RSM 512x512, N = 1024, "
      "2048 on "
      "the G-buffer: counted while\nrecorded; ours include mipmapping, which the paper leaves to the "
      "graphics API. "
      "Published: [MFIS16] Tab. 3.\n";
  return out;
}

Json to_json(const CodeSize& s) {
  Json j = {{"method", s.method},
            {"kernels", s.kernels},
            {"dispatches", {{"gbuffer", s.gbuffer_dispatches}, {"rsm", s.rsm_dispatches}}},
            {"own_lines", s.own_lines},
            {"shared_lines", s.shared_lines},
            {"own_files", s.own_files},
            {"shared_files", s.shared_files}};
  if (s.published) {
    j["published"] = {{"shaders", s.published->shaders},
                      {"dispatches", s.published->dispatches},
                      {"lines", s.published->lines},
                      {"source", "[MFIS16] Tab. 3"}};
  }
  return j;
}

}  // namespace vsglbench
