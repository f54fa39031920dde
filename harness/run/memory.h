// Whether a case fits into memory, asked before anything is allocated: where memory is overcommitted, asking
// for too much ends in the process being killed, and not in an error.
#pragma once

#include <cstdint>

#include "gpu/device.h"
#include "reference/reference.h"
#include "run/sweep.h"

namespace vsglbench {

// Bytes that the host can still give: what the kernel calls available, within the limits of the process
// and its control group.
// UINT64_MAX where the system does not tell.
uint64_t available_memory();

// Estimates from the largest arrays; small things are left out.
struct MemoryNeed {
  uint64_t host = 0, device = 0;
};
MemoryNeed reference_memory(uint32_t width, uint32_t height);
// What one frame needs. `lights`: as many as the method makes; bits of exact visibility are kept for each of
// them.
MemoryNeed frame_memory(const Case& c);

// Throws Error(case_failed) when what the case needs, beside `taken` bytes that others of its scene will
// keep, is more than there is. On a device that is a CPU both kinds of memory are the host's.
void require_memory(const DeviceInfo& device, const Case& c, uint64_t taken = 0);
void require_reference_memory(uint32_t width, uint32_t height);

// Bytes that the case keeps while the others of its scene run: its visibility bits.
uint64_t kept_memory(const Case& c);

}  // namespace vsglbench
