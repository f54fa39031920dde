// Work spread over threads.
#pragma once

#include <cstdint>
#include <functional>

namespace vsglbench {

// The number of threads to use when 0 are asked for: all of the machine.
unsigned thread_count(unsigned asked);

// Calls work(i, thread) for every i in [0, count), thread in [0, thread_count(threads)), each i once, in
// ascending order within a thread. Denormals are flushed to zero meanwhile (Embree's advice; so that all
// threads round alike). The first exception stops the rest and is thrown here.
void parallel_for(uint64_t count, unsigned threads,
                  const std::function<void(uint64_t i, unsigned thread)>& work);

}  // namespace vsglbench
