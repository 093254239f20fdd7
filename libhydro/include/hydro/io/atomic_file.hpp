#pragma once
/// \file  Files that are whole or absent: written under a temporary name beside the target, synced, renamed.
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

/// Fails early, before hours of work, if a file at `path` could not be created. Leaves nothing behind.
/// \throws InputError
void require_writable(const std::filesystem::path& path);

/// The whole of a file. \throws InputError if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace hydro::io
