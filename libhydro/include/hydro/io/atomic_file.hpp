#pragma once
/// \file  Files that are whole or absent: written under a temporary name beside the target, synced, renamed. A symbolic
/// link stays, and the file that it points to is replaced. What is no file (a device, a FIFO, /dev/stdout) is written
/// into as it is.
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace hydro::io {

/// Writes `bytes` to `path`. On failure nothing is left behind and an older file at `path` is untouched.
/// \throws InputError when the folder is missing or not writable, or the disk is full, with the system's reason.
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// Fails early, before hours of work, if `path` could not be written. Leaves nothing behind.
/// \throws InputError
void require_writable(const std::filesystem::path& path);

/// True if what is written to one path would be read from the other: links are followed, two names of one file are the
/// same, and files need not exist yet. Devices, FIFOs and folders are the same as nothing, since nothing is replaced.
/// \throws InputError for links that lead in a circle
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The whole of a file. \throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace hydro::io
