#pragma once
/// \file  How far a fit has come: what its searches tell their caller.
#include <functional>
#include <utility>

namespace fit {

/// While one lives, searches of the thread that made it tell after each iteration how far they are: a share in [0, 1)
/// that never falls. Each search fills half of what is left, since how many there will be shows only as they come;
/// within a search it is the decades by which the change of the cost has come down to that at which the search ends, or
/// the iterations that are spent, whichever is more. What `told` throws ends the fit. One within another stands for it.
class SearchWatch {
 public:
  explicit SearchWatch(std::function<void(double share)> told)
      : told_(std::move(told)), before_(std::exchange(current(), this)) {}
  ~SearchWatch() { current() = before_; }
  SearchWatch(const SearchWatch&) = delete;
  SearchWatch& operator=(const SearchWatch&) = delete;

  /// That of this thread; null where there is none.
  static SearchWatch*& current() {
    thread_local SearchWatch* one = nullptr;
    return one;
  }
  /// By a search that has come to this share of itself, in [0, 1]. \throws what `told` throws
  void come_to(double share_of_search) {
    if (!(share_of_search > in_search_)) return;
    in_search_ = share_of_search;
    told_(1 - left_ * (1 - in_search_ / 2));
  }
  /// By a search that is over.
  void end_search() {
    come_to(1);
    left_ /= 2;
    in_search_ = 0;
  }

 private:
  std::function<void(double)> told_;
  SearchWatch* before_;
  double left_ = 1, in_search_ = 0;
};

}  // namespace fit
