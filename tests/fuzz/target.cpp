// One libFuzzer target; RL_FUZZ_ENTRY names its reader.
#include "tests/fuzz/entries.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t count);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t count) {
  restlab::fuzz::RL_FUZZ_ENTRY(bytes, count);
  return 0;
}
