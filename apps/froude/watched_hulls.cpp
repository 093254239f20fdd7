#include "froude/watched_hulls.hpp"

#include "compile/hulls.hpp"
#include "froude/signals.hpp"

namespace froude {

WatchedHulls::WatchedHulls(const Console& console) : err_(console.err), shown_(console.show_progress) {
  compile::watch_hulls([this](int done, int all) { update(done, all); });
}

WatchedHulls::~WatchedHulls() { compile::watch_hulls({}); }

void WatchedHulls::update(int done, int all) {
  const std::scoped_lock lock(one_at_a_time_);
  if (asks_to_end(&Signals::asked()))
    throw EndedBySignal(Signals::asked(), sentence(Signals::asked()) + " while hulls were solved");
  if (!bar_) bar_.emplace(err_, "solve", shown_);
  bar_->update(static_cast<double>(done) / all);
  if (done == all) bar_.reset();
}

}  // namespace froude
