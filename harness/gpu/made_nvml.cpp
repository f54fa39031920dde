// Tests only: a library in NVML's place that knows one device, and no temperature.
#include <cstring>

extern "C" {
int nvmlInit_v2() { return 0; }
int nvmlShutdown() { return 0; }
int nvmlDeviceGetHandleByUUID(const char* uuid, void** device) {
  static int made;
  *device = &made;
  return std::strcmp(uuid, "GPU-00112233-4455-6677-8899-aabbccddeeff") == 0 ? 0 : 6;  // not found
}
int nvmlDeviceGetHandleByIndex_v2(unsigned index, void** device) {
  static int made;
  *device = &made;
  return index == 3 ? 0 : 2;  // invalid argument
}
int nvmlDeviceGetUUID(void*, char* uuid, unsigned length) {
  std::strncpy(uuid, "GPU-00112233-4455-6677-8899-aabbccddeeff", length);
  return 0;
}
int nvmlDeviceGetClockInfo(void*, unsigned type, unsigned* mhz) {
  *mhz = type == 1 ? 1980 : 3201;
  return 0;
}
int nvmlDeviceGetTemperature(void*, unsigned, unsigned*) { return 3; }  // not supported
int nvmlDeviceGetPerformanceState(void*, int* state) {
  *state = 2;
  return 0;
}
int nvmlDeviceGetPowerUsage(void*, unsigned* milliwatts) {
  *milliwatts = 412500;
  return 0;
}
int nvmlDeviceGetCurrentClocksThrottleReasons(void*, unsigned long long* bits) {
  *bits = 0x1 | 0x4 | 0x40;  // idle, power cap, hot
  return 0;
}
}
