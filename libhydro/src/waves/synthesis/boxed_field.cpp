#include "hydro/waves/synthesis/boxed_field.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <mutex>
#include <utility>

#include "hydro/base/error.hpp"

namespace hydro::waves {
namespace {

using Table = std::shared_ptr<const TabulatedField>;

TabulatedField::Options options_of(const FieldUse& use) {
  return {use.tolerance, use.largest_bytes, use.elevation_only};
}

/// The first of `count` equal spans of time.
FieldUse one_of(FieldUse use, int count) {
  use.box.end_s = use.box.start_s + (use.box.end_s - use.box.start_s) / count;
  use.instants /= count;
  return use;
}

/// How many spans bring a table down to the memory allowed: to a quarter of it where there are several, since that many
/// may be in use at once. 0 where no number does, or the tolerance cannot be reached.
int spans_for(const HarmonicField& field, const FieldUse& use) {
  constexpr int most = 4096;
  const auto fits = [&](int count, double share) {
    return TabulatedField::expected_bytes(field, one_of(use, count).box, options_of(use)) <=
           share * static_cast<double>(use.largest_bytes);
  };
  try {
    if (fits(1, 1)) return 1;
    for (int count = 2; count <= most; count *= 2)
      if (fits(count, 0.25)) return count;
  } catch (const InputError&) {
  }
  return 0;
}

bool holds(const FieldBox& box, double x, double y) {
  return x >= box.low.x() && x <= box.high.x() && y >= box.low.y() && y <= box.high.y();
}

bool holds(const FieldBox& box, const Eigen::Vector3d& p) {
  return holds(box, p.x(), p.y()) && p.z() >= box.low.z() && p.z() <= box.high.z();
}

}  // namespace

/// Tables one after the other in time. Whoever asks for one first makes it; threads that ask for the same wait.
class BoxedField::Spans {
 public:
  Spans(const HarmonicField& field, const FieldUse& use, int count) : field_(field), use_(use), count_(count) {
    if (count == 1) only_ = made(0);
  }

  int count() const { return count_; }
  const FieldBox& box() const { return use_.box; }
  bool holds(double t) const { return t >= box().start_s && t <= box().end_s; }
  std::size_t bytes() const {
    return only_ ? only_->bytes()
                 : static_cast<std::size_t>(
                       TabulatedField::expected_bytes(field_, one_of(use_, count_).box, options_of(use_)));
  }
  Table at(double t) {
    return only_ ? only_ : of(std::clamp(static_cast<int>((t - begin(0)) / length()), 0, count_ - 1));
  }

 private:
  double length() const { return (box().end_s - box().start_s) / count_; }
  double begin(int span) const { return box().start_s + span * length(); }

  Table made(int span) const {
    constexpr double rounding = 1e-9;  // s: an instant at the seam may lie on either side
    FieldBox box = use_.box;
    if (count_ > 1) {
      box.start_s = begin(span) - rounding;
      box.end_s = begin(span + 1) + rounding;
    }
    return std::make_shared<const TabulatedField>(field_, box, options_of(use_));
  }
  Table of(int span) {
    std::shared_future<Table> found;
    {
      const std::scoped_lock one_at_a_time(mutex_);
      const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const auto& k) { return k.first == span; });
      if (known != kept_.end()) {
        std::rotate(kept_.begin(), known, known + 1);
      } else {
        constexpr std::size_t most = 3;  // runs at two places in time, and one that looks ahead
        kept_.emplace_front(span, std::async(std::launch::deferred, [this, span] { return made(span); }).share());
        if (kept_.size() > most) kept_.pop_back();
      }
      found = kept_.front().second;
    }
    return found.get();
  }

  HarmonicField field_;
  FieldUse use_;
  int count_;
  Table only_;
  std::mutex mutex_;
  std::deque<std::pair<int, std::shared_future<Table>>> kept_;  // the last that was asked for comes first
};

BoxedField::BoxedField(const HarmonicField& field, const FieldUse& use) : sum_(field) {
  const int count = spans_for(field, use);
  if (cheapest_method(field, one_of(use, std::max(1, count))) == FieldMethod::table)
    spans_ = std::make_unique<Spans>(field, use, count);
}

BoxedField::~BoxedField() = default;

int BoxedField::tables() const noexcept { return spans_ ? spans_->count() : 0; }

std::size_t BoxedField::bytes_of_table() const noexcept { return spans_ ? spans_->bytes() : 0; }

Table BoxedField::table(double t) const { return spans_ ? spans_->at(t) : nullptr; }

double BoxedField::elevation(double t, double x, double y) const {
  return spans_ && spans_->holds(t) && holds(spans_->box(), x, y) ? spans_->at(t)->elevation(t, x, y)
                                                                  : sum_.elevation(t, x, y);
}

Kinematics BoxedField::at(double t, const Eigen::Vector3d& point) const {
  return spans_ && spans_->holds(t) && holds(spans_->box(), point) ? spans_->at(t)->at(t, point) : sum_.at(t, point);
}

void BoxedField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  if (!spans_ || !spans_->holds(t)) return sum_.at(t, points, out);
  const auto inside = [&](const Eigen::Vector3d& p) { return holds(spans_->box(), p); };
  if (std::all_of(points.begin(), points.end(), inside))
    spans_->at(t)->at(t, points, out);
  else if (std::any_of(points.begin(), points.end(), inside))
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(t, points[i]);
  else
    sum_.at(t, points, out);
}

}  // namespace hydro::waves
