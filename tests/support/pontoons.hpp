#pragma once
// Floating modules of four cylinders in the text of scenes: those of examples/data/pontoon*.nc.
#include <fmt/format.h>

#include <string>

namespace support {

/// A row along x, 13 m apart, named m1, m2, … unless told otherwise; keys of [[body]] may follow.
inline std::string pontoons(int count, const std::string& first = "(0, 0, 0) m", const std::string& name = "m") {
  return fmt::format(R"([[body]]
name = "{}"
position = "{}"
copies = {{ count = {}, step = "(13, 0, 0) m" }}
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
)",
                     name, first, count);
}

}  // namespace support
