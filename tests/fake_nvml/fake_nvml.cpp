// Stands in for NVIDIA's management library in tests. What it does is chosen through environment
// variables, read at each call:
//   FAKE_NVML_FAIL         "function=code,function=code": these functions return these codes
//   FAKE_NVML_NAME         product name
//   FAKE_NVML_COUNT        number of GPUs (default 1)
//   FAKE_NVML_DRIVER       driver version
//   FAKE_NVML_MIG          1: split into instances
//   FAKE_NVML_MILLISECONDS time since the driver was loaded; the counter steps each 100 of them
//   FAKE_NVML_MILLIWATTS   power
//   FAKE_NVML_FIELD_TYPE   type of the field's value (0 double, 1 u32, 3 u64)
//   FAKE_NVML_FIELD_RESULT result inside of the field's value
// Built with FAKE_NVML_OLD it lacks the functions that old drivers lack.
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

int starts = 0;
int ends = 0;
int devices_touched = 0;
int gpu = 0;

long number(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtol(text, nullptr, 10) : otherwise;
}

int failure(const char* function) {
  const char* text = std::getenv("FAKE_NVML_FAIL");
  if (text == nullptr) return 0;
  const std::string list = std::string(",") + text;
  const std::string key = std::string(",") + function + "=";
  const std::size_t at = list.find(key);
  return at == std::string::npos ? 0 : std::atoi(list.c_str() + at + key.size());
}

int give_text(const char* function, const char* variable, const char* otherwise, char* buffer,
              unsigned size) {
  if (const int code = failure(function); code != 0) return code;
  const char* text = std::getenv(variable);
  std::strncpy(buffer, text != nullptr ? text : otherwise, size);
  return 0;
}

int give_device(const char* function, void** device) {
  if (const int code = failure(function); code != 0) return code;
  if (starts == ends) return 1;
  ++devices_touched;
  *device = &gpu;
  return 0;
}

}  // namespace

extern "C" {

// For the tests: how often NVML was started, ended, and a device was asked for.
int fake_nvml_starts() {
  return starts;
}
int fake_nvml_ends() {
  return ends;
}
int fake_nvml_devices_touched() {
  return devices_touched;
}

int nvmlInit_v2() {
  if (const int code = failure("init"); code != 0) return code;
  ++starts;
  return 0;
}
int nvmlShutdown() {
  ++ends;
  return 0;
}
int nvmlDeviceGetCount_v2(unsigned* count) {
  *count = static_cast<unsigned>(number("FAKE_NVML_COUNT", 1));
  return failure("count");
}
int nvmlDeviceGetHandleByIndex_v2(unsigned, void** device) {
  return give_device("index", device);
}
int nvmlDeviceGetHandleByPciBusId_v2(const char*, void** device) {
  return give_device("pci", device);
}
int nvmlDeviceGetName(void*, char* text, unsigned size) {
  return give_text("name", "FAKE_NVML_NAME", "NVIDIA GeForce RTX 3090", text, size);
}
int nvmlDeviceGetUUID(void*, char* text, unsigned size) {
  return give_text("uuid", "FAKE_NVML_UUID", "GPU-11111111", text, size);
}
int nvmlDeviceGetPowerUsage(void*, unsigned* milliwatts) {
  if (const int code = failure("usage"); code != 0) return code;
  *milliwatts = static_cast<unsigned>(number("FAKE_NVML_MILLIWATTS", 100000));
  return 0;
}

#ifndef FAKE_NVML_OLD

int nvmlSystemGetDriverVersion(char* text, unsigned size) {
  return give_text("driver", "FAKE_NVML_DRIVER", "550.54.15", text, size);
}
int nvmlDeviceGetMigMode(void*, unsigned* current, unsigned* pending) {
  if (const int code = failure("mig"); code != 0) return code;
  *current = *pending = static_cast<unsigned>(number("FAKE_NVML_MIG", 0));
  return 0;
}
int nvmlDeviceGetTotalEnergyConsumption(void*, unsigned long long* millijoules) {
  if (const int code = failure("energy"); code != 0) return code;
  const auto updates =
      static_cast<unsigned long long>(number("FAKE_NVML_MILLISECONDS", 1000)) / 100;
  const auto milliwatts = static_cast<unsigned long long>(number("FAKE_NVML_MILLIWATTS", 100000));
  *millijoules = updates * milliwatts / 10;
  return 0;
}

struct FieldValue {
  unsigned field;
  unsigned scope;
  long long timestamp;
  long long latency;
  unsigned type;
  int result;
  union {
    double as_double;
    unsigned as_u32;
    unsigned long long as_u64;
  };
};

int nvmlDeviceGetFieldValues(void*, int count, FieldValue* values) {
  if (const int code = failure("fields"); code != 0) return code;
  const long milliwatts = number("FAKE_NVML_MILLIWATTS", 100000);
  for (int i = 0; i < count; ++i) {
    FieldValue& value = values[i];
    value.type = static_cast<unsigned>(number("FAKE_NVML_FIELD_TYPE", 1));
    value.result = value.field == 186 && value.scope == 0
                       ? static_cast<int>(number("FAKE_NVML_FIELD_RESULT", 0))
                       : 3;
    value.as_u64 = ~0ULL;
    if (value.type == 0) value.as_double = static_cast<double>(milliwatts);
    if (value.type == 1) value.as_u32 = static_cast<unsigned>(milliwatts);
    if (value.type == 3) value.as_u64 = static_cast<unsigned long long>(milliwatts);
  }
  return 0;
}

#endif

}  // extern "C"
