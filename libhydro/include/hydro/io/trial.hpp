#pragma once
/// \file  What a library may not survive is tried in a child process first.
///
/// HDF5 and netCDF-C trust a file: one with altered lengths or pointers ends them by a signal, or has them search a
/// heap without end. No look at the file from outside tells which will; a child that reads it does.
#include <filesystem>
#include <functional>

namespace hydro::io {

/// How long a child may take: of processor time, and by the clock, s.
struct TrialLimits {
  unsigned processor, clock;
};
/// Of processor time 2 s and a second for each 10 MB, a hundred times what small files take and a hundredth of the
/// speed of disks; by the clock ten times that and 10 s, for machines that do other things too.
TrialLimits limits_of(const std::filesystem::path& file);

/// Calls `read` in a copy of this process, whose result is thrown away, before the caller does it for himself. What
/// `read` throws is no concern of this: the caller's own call throws it again.
///
/// Costs what `read` costs, and a fork: a millisecond for a program of 100 MB.
/// \throws InputError naming the file if the child ends by a signal (a fault of memory) or takes longer than reading
///         does, by the clock in each of three tries
void try_in_child(const std::filesystem::path& file, const std::function<void()>& read, const TrialLimits& limits);
inline void try_in_child(const std::filesystem::path& file, const std::function<void()>& read) {
  try_in_child(file, read, limits_of(file));
}

/// Whether the file begins as HDF5 does.
bool is_hdf5(const std::filesystem::path& file);

/// What `read` gives of a file that may be HDF5, which is then tried first. \throws as try_in_child(), and `read`
template <class Read>
auto read_tried(const std::filesystem::path& file, const Read& read) {
  if (is_hdf5(file)) try_in_child(file, [&] { (void)read(); });
  return read();
}

}  // namespace hydro::io
