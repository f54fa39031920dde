#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace vsglbench {
namespace {

// Flush-to-zero and denormals-are-zero, for as long as it lives.
class FlushDenormals {
 public:
#if defined(__SSE__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#endif
};

}  // namespace

unsigned thread_count(unsigned asked) {
  return asked > 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

void parallel_for(uint64_t count, unsigned threads, const std::function<void(uint64_t, unsigned)>& work) {
  threads = static_cast<unsigned>(std::min<uint64_t>(thread_count(threads), count));
  std::atomic<uint64_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto run = [&](unsigned thread) {
    const FlushDenormals guard;
    try {
      for (uint64_t i; (i = next.fetch_add(1)) < count;) work(i, thread);
    } catch (...) {
      std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::jthread> others;
  for (unsigned t = 1; t < threads; ++t) others.emplace_back(run, t);
  if (threads > 0) run(0);
  others.clear();  // joins
  if (error) std::rethrow_exception(error);
}

}  // namespace vsglbench
