// Which attributes an object of an HDF5 file has: a report shows whatever was kept, without knowing its names.
#include "hydro/base/error.hpp"
#include "report/contents.hpp"
#include "view/hdf5_handle.hpp"

namespace froude::html {
std::vector<std::string> attribute_names(const std::filesystem::path& file, const std::string& object) {
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  const Hdf5Handle of(opened.get() < 0 ? -1 : H5Oopen(opened.get(), object.c_str(), H5P_DEFAULT), &H5Oclose);
  std::vector<std::string> out;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* names) -> herr_t {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  };
  hsize_t begin = 0;
  // Objects that keep no order of creation are asked again, by name.
  if (of.get() >= 0 && H5Aiterate2(of.get(), H5_INDEX_CRT_ORDER, H5_ITER_INC, &begin, add, &out) >= 0) return out;
  out.clear(), begin = 0;
  if (of.get() < 0 || H5Aiterate2(of.get(), H5_INDEX_NAME, H5_ITER_NATIVE, &begin, add, &out) < 0)
    throw hydro::InputError(object + " has no attributes that can be read", {.file = file.string()}, "write it again");
  return out;
}

}  // namespace froude::html
