#include "harness/case.hpp"

#include "hydro/base/error.hpp"

namespace froude::validation {

std::filesystem::path Folders::example(const std::string& file) const {
  const std::filesystem::path path = cases_.parent_path() / "examples" / "data" / file;
  if (!std::filesystem::exists(path))
    throw hydro::InputError("the case needs this file, which comes with Froude", {.file = path.string()},
                            "give the folder of the cases as it stands in the source tree or the installation");
  return path;
}

std::filesystem::path Folders::shared(const std::string& file) const {
  const std::filesystem::path path = data_ / file;
  if (data_.empty() || !std::filesystem::exists(path)) throw MissingData(file);
  return path;
}

}  // namespace froude::validation
