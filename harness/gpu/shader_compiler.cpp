#include "gpu/shader_compiler.h"

#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <chrono>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "gpu/contraction.h"
#include "gpu/loop_check.h"
#include "gpu/spirv_cache.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

ShaderStatistics statistics;

// Everything one glslang shader needs beyond its text; the limits of a Vulkan 1.3 device are not restated
// here: the driver checks its own.
TBuiltInResource resource_limits() {
  TBuiltInResource limits{};
  int* first = &limits.maxLights;
  int* last = &limits.maxSamples;
  for (int* p = first; p <= last; ++p) *p = 65536;
  limits.minProgramTexelOffset = -8;
  limits.maxProgramTexelOffset = 7;
  limits.limits.nonInductiveForLoops = true;
  limits.limits.whileLoops = true;
  limits.limits.doWhileLoops = true;
  limits.limits.generalUniformIndexing = true;
  limits.limits.generalAttributeMatrixVectorIndexing = true;
  limits.limits.generalVaryingIndexing = true;
  limits.limits.generalSamplerIndexing = true;
  limits.limits.generalVariableIndexing = true;
  limits.limits.generalConstantMatrixVectorIndexing = true;
  return limits;
}

class FileIncluder : public glslang::TShader::Includer {
 public:
  explicit FileIncluder(const std::vector<fs::path>& dirs) : dirs_(dirs) {}
  IncludeResult* includeLocal(const char* header, const char* includer, size_t depth) override {
    if (depth > 32) return nullptr;
    std::vector<fs::path> candidates = {fs::path(includer).parent_path() / header};
    for (const auto& dir : dirs_) candidates.push_back(dir / header);
    for (const auto& candidate : candidates) {
      std::error_code ec;
      if (!fs::is_regular_file(candidate, ec)) continue;
      auto* text = new std::string(read_text(candidate));
      return new IncludeResult(candidate.string(), text->data(), text->size(), text);
    }
    return nullptr;
  }
  IncludeResult* includeSystem(const char* h, const char* i, size_t d) override {
    return includeLocal(h, i, d);
  }
  void releaseInclude(IncludeResult* result) override {
    if (!result) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
  }

 private:
  const std::vector<fs::path>& dirs_;
};

EShLanguage stage_of(const fs::path& path) {
  const std::string suffix = path.extension().string();
  if (suffix == ".comp") return EShLangCompute;
  if (suffix == ".vert") return EShLangVertex;
  if (suffix == ".frag") return EShLangFragment;
  throw fail(ErrorKind::plugin, "{}: a kernel's name ends in .comp, .vert or .frag", path.string());
}

// glslang's log starts "ERROR: FILE:LINE: what"; only the first error is news.
[[noreturn]] void report(const fs::path& path, const std::string& log) {
  constexpr std::string_view kError = "ERROR: ";
  const size_t error = log.find(kError), first = error == std::string::npos ? 0 : error + kError.size();
  std::string what = log.substr(first, log.find('\n', first) - first);
  what.resize(what.find_last_not_of(' ') + 1);
  // An error in an include names that file; the kernel it belongs to goes first.
  if (what.starts_with(path.string())) throw Error(ErrorKind::plugin, what);
  throw fail(ErrorKind::plugin, "{}: {}", path.string(), what);
}

// Compiler errors carry the file's name because the shader was given it.
struct Source {
  fs::path path;
  EShLanguage stage;
  std::string text, preamble, name;
  const char* text_pointer;
  const char* name_pointer;
  int length;

  Source(const fs::path& p, const ShaderDefines& defines) : path(p), stage(stage_of(p)), name(p.string()) {
    try {
      text = read_text(p);
    } catch (const Error& e) {
      throw Error(ErrorKind::plugin, e.what());
    }
    preamble = "#extension GL_GOOGLE_include_directive : require\n";
    for (const auto& [key, value] : defines) preamble += fmt::format("#define {} {}\n", key, value);
    if (stage == EShLangCompute && defines.contains(loop_check_define)) {
      preamble += "#define main vsglbench_main\n";
      text += LoopCheck::kSource;
    }
    text_pointer = text.c_str();
    name_pointer = name.c_str();
    length = static_cast<int>(text.size());
  }
  void set_up(glslang::TShader& shader) const {
    shader.setStringsWithLengthsAndNames(&text_pointer, &length, &name_pointer, 1);
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  }
};

constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

std::string preprocess(const Source& source, const TBuiltInResource& limits, FileIncluder& includer) {
  glslang::TShader shader(source.stage);
  source.set_up(shader);
  std::string out;
  if (!shader.preprocess(&limits, 460, ENoProfile, false, false, kMessages, &out, includer)) {
    report(source.path, shader.getInfoLog());
  }
  return out;
}

std::vector<uint32_t> compile(const Source& source, const TBuiltInResource& limits, FileIncluder& includer) {
  glslang::TShader shader(source.stage);
  source.set_up(shader);
  if (!shader.parse(&limits, 460, false, kMessages, includer)) report(source.path, shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(kMessages)) report(source.path, program.getInfoLog());
  std::vector<uint32_t> spirv;
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  glslang::GlslangToSpv(*program.getIntermediate(source.stage), spirv, &options);
  set_contraction(contraction_asked(), &spirv);
  return spirv;
}

}  // namespace

std::vector<uint32_t> compile_shader(const fs::path& path, const ShaderDefines& defines,
                                     const std::vector<fs::path>& include_dirs) {
  static const bool initialised = glslang::InitializeProcess();
  if (!initialised) throw fail(ErrorKind::plugin, "glslang cannot be initialised");
  const auto start = std::chrono::steady_clock::now();
  const TBuiltInResource limits = resource_limits();
  FileIncluder includer(include_dirs);
  const Source source(path, defines);
  // The key: what the preprocessor makes of source, includes and defines.
  Hasher hasher;
  hasher.text(preprocess(source, limits, includer)).value(source.stage).value(contraction_asked());
  for (const int v : {GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH}) hasher.value(v);
  const fs::path cached = cache_directory() / "spirv" / (hasher.hex() + ".spv");

  std::vector<uint32_t> spirv;
  if (read_cached_spirv(cached, &spirv)) {
    ++statistics.from_cache;
  } else {
    spirv = compile(source, limits, includer);
    write_cached_spirv(cached, spirv);
    ++statistics.compiled;
  }
  statistics.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return spirv;
}

std::string kernel_sources_hash() {
  std::map<std::string, fs::path> files;  // by relative path, so that the order is everywhere the same
  for (const char* folder : {"harness", "methods"}) {
    std::error_code ec;
    for (const auto& entry : fs::recursive_directory_iterator(data_root() / folder, ec)) {
      const std::string suffix = entry.path().extension().string();
      const bool kernel = suffix == ".comp" || suffix == ".glsl" || suffix == ".vert" || suffix == ".frag";
      if (kernel || entry.path().filename() == "types.h") {
        files[fs::relative(entry.path(), data_root()).string()] = entry.path();
      }
    }
  }
  Hasher hasher;
  for (const auto& [name, path] : files) hasher.text(name).text(read_text(path));
  if (const Contraction c = contraction_asked(); c != Contraction::as_written)
    hasher.text(fmt::format("contraction {}", static_cast<int>(c)));
  return hasher.hex();
}

const ShaderStatistics& shader_statistics() { return statistics; }

}  // namespace vsglbench
