#pragma once
/// \file  Numbers that may be absent, in JSON.
#include <nlohmann/json.hpp>
#include <optional>

namespace froude {

template <class T>
nlohmann::json json_or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace froude
