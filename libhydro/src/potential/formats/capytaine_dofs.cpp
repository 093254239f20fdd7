#include <algorithm>
#include <cctype>
#include <limits>

#include "capytaine.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"

namespace hydro::potential {
namespace {

constexpr std::size_t absent = std::numeric_limits<std::size_t>::max();

struct Label {
  std::string body, mode;
};

Label split(const std::string& label) {
  const std::size_t at = label.rfind("__");  // the last one: a body's own name may contain it
  Label out = at == std::string::npos ? Label{"", label} : Label{label.substr(0, at), label.substr(at + 2)};
  std::transform(out.mode.begin(), out.mode.end(), out.mode.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string shown(const std::string& body, std::string_view mode) {
  return body.empty() ? std::string(mode) : fmt::format("{}__{}", body, mode);
}

}  // namespace

CapytaineDofs order_dofs(const std::vector<std::string>& labels, const std::filesystem::path& file,
                         const std::string& axis) {
  const Place place{.file = file.string()};
  CapytaineDofs dofs;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const Label label = split(labels[k]);
    const auto mode = std::find(mode_names.begin(), mode_names.end(), label.mode);
    if (mode == mode_names.end())
      throw InputError(
          fmt::format("\"{}\" in {} is no rigid-body mode but a generalised (flexible) one", labels[k], axis), place,
          "Froude reads surge, sway, heave, roll, pitch and yaw; compute without other degrees of freedom");
    auto body = std::find(dofs.body.begin(), dofs.body.end(), label.body);
    if (body == dofs.body.end()) {
      body = dofs.body.insert(dofs.body.end(), label.body);
      dofs.index_in_file.resize(6 * dofs.body.size(), absent);
    }
    std::size_t& index =
        dofs.index_in_file[static_cast<std::size_t>(6 * (body - dofs.body.begin()) + (mode - mode_names.begin()))];
    if (index != absent) throw InputError(fmt::format("\"{}\" is in {} twice", labels[k], axis), place);
    index = k;
  }
  for (std::size_t m = 0; m < dofs.index_in_file.size(); ++m)
    if (dofs.index_in_file[m] == absent)
      throw InputError(fmt::format("\"{}\" is missing from {}", shown(dofs.body[m / 6], mode_names[m % 6]), axis),
                       place, "give each body all six rigid modes, for example with body.add_all_rigid_body_dofs()");
  return dofs;
}

}  // namespace hydro::potential
