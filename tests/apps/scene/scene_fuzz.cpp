// The reader of scenes under libFuzzer. Data that a scene names are not there, so that what needs them is refused.
#include "scene/scene.hpp"

#include "support/fuzz_entry.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return froude_fuzz::give([](std::string_view text) { (void)froude::scene::parse(text, "scene.toml"); }, data, size);
}
