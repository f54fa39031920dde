// What frames keep in memory: many are open at once, and each is rendered many times.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "frame/frame.h"
#include "method/registry.h"
#include "scene/scene_file.h"

using namespace vsglbench;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kKeepsFreedMemory = true;  // the sanitizer, for a while
#else
constexpr bool kKeepsFreedMemory = false;
#endif

int64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  int64_t all = 0, resident = 0;
  in >> all >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

double mib(int64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

struct Session {
  explicit Session(const char* name)
      : scene(load_scene(name, {data_root() / "scenes", {}})),
        kernels(device),
        stage(device, kernels, scene) {}
  std::unique_ptr<Frame> frame(const std::string& method) {
    const MethodInfo& info = load_method(method, device.info());
    const FrameParameters p{.width = 32,
                            .height = 18,
                            .rsm = 16,
                            .lights = 16,
                            .importance_lights = 16,
                            .visibility = Visibility::none};
    return std::make_unique<Frame>(stage, info, resolve_parameters(info, Json::object()), p,
                                   ExactVisibility{});
  }
  Device device;
  const Scene scene;
  KernelLibrary kernels;
  Stage stage;
};

}  // namespace

// Beside its buffers a frame has a command buffer, descriptor sets and what the method's host side holds, far
// below the margin. On lavapipe it was 15 MiB a frame: a shader that the driver kept anew for every draw.
TEST(OpenFrames, KeepLittleBesideTheirBuffers) {
  if (kKeepsFreedMemory) GTEST_SKIP();
  constexpr int kFrames = 40, kFirst = 8;  // which fill what all share: kernels, targets, the driver's pools
  constexpr double kMarginMib = 1;
  Session session("colonnade");
  std::vector<std::unique_ptr<Frame>> frames;
  int64_t resident = 0, buffers = 0;
  for (int i = 0; i < kFirst + kFrames; ++i) {
    if (i == kFirst) resident = resident_bytes();
    if (i == kFirst) buffers = static_cast<int64_t>(session.device.allocated_bytes());
    frames.push_back(session.frame("fis"));
    frames.back()->render(0);
  }
  resident = resident_bytes() - resident;
  buffers = static_cast<int64_t>(session.device.allocated_bytes()) - buffers;
  std::printf("%.2f MiB a frame, of which buffers %.2f\n", mib(resident) / kFrames, mib(buffers) / kFrames);
  EXPECT_LT(mib(resident - buffers) / kFrames, kMarginMib);
}

// The same frame again needs nothing more: neither its draws nor any method's dispatches. A shader that the
// driver keeps at every draw or dispatch takes half a MiB and more.
TEST(OpenFrames, RenderingAgainKeepsNothing) {
  if (kKeepsFreedMemory) GTEST_SKIP();
  constexpr uint32_t kFrames = 24, kFirst = 8;
  constexpr double kMarginMib = 0.25;
  Session session("cornell");
  for (const MethodInfo* method : all_methods()) {
    const auto frame = session.frame(method->name);
    int64_t resident = 0;
    for (uint32_t i = 0; i < kFirst + kFrames; ++i) {
      if (i == kFirst) resident = resident_bytes();
      frame->render(i);
    }
    resident = resident_bytes() - resident;
    std::printf("%-20s %.3f MiB a frame\n", method->name.c_str(), mib(resident) / kFrames);
    EXPECT_LT(mib(resident) / kFrames, kMarginMib) << method->name;
  }
}
