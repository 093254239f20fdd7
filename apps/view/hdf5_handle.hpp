#pragma once
/// \file  Private to apps: an identifier of HDF5's own interface, for what hydro::io::Hdf5Reader does not tell.
#include <hdf5.h>

namespace froude {

/// It is closed as its kind is: by H5Fclose, H5Dclose or H5Oclose. A negative one is nothing, and stays so.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace froude
