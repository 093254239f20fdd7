#include "hydro/waves/synthesis/tabulated_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "field_number.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"
#include "synth_axis.hpp"
#include "synth_band.hpp"
#include "synth_flow.hpp"
#include "synth_table_cost.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;
using simd::padded;
constexpr double oversampling = 2;

/// Axis b lies along the waves, or along y; axis a along x, with one sample if the sea is long-crested.
struct Axes {
  Axis time, a, b;
};

Axes axes_of(const Window& window, const BinBand& band, const FieldBox& box) {
  Axes out;
  out.time = Axis::along(window, box.start_s, box.end_s, band.omega);
  double low = box.low.y(), high = box.high.y();
  if (band.long_crested) {
    const Eigen::Vector2d e = band.along;
    low = std::min(e.x() * box.low.x(), e.x() * box.high.x()) + std::min(e.y() * box.low.y(), e.y() * box.high.y());
    high = std::max(e.x() * box.low.x(), e.x() * box.high.x()) + std::max(e.y() * box.low.y(), e.y() * box.high.y());
  } else {
    out.a = Axis::along(window, box.low.x(), box.high.x(), band.kappa);
  }
  out.b = Axis::along(window, low, high, band.kappa);
  return out;
}

// Projections of the wave vector onto the axes.
double along_a(const Harmonic& w, const BinBand& band) { return band.long_crested ? 0 : w.kx; }
double along_b(const Harmonic& w, const BinBand& band) {
  return band.long_crested ? w.kx * band.along.x() + w.ky * band.along.y() : w.ky;
}

}  // namespace

struct TabulatedField::Content {
  struct Heights;
  class Now;
  Surroundings around;
  FieldBox box;
  BinBand band;
  Window window;
  Axes axes;
  std::optional<VerticalBasis> vertical;
  std::size_t row = 0;  // of the elevation table: stations along b and what packs read beyond them
  std::vector<double> elevation, potential;
  double relative_error = 0;
  FieldError bound{};
  std::uint64_t number = next_field_number();

  table::Strides elevation_strides() const { return {axes.a.count * row, row, 1}; }
  table::Strides potential_strides() const {
    const std::size_t q = vertical->padded();
    return {axes.a.count * axes.b.count * q, axes.b.count * q, q};
  }
  double along_b_of(double x, double y) const {
    return band.long_crested ? x * band.along.x() + y * band.along.y() : y;
  }
  void require_inside(double t, double x, double y) const;
  void require_flow(double z) const;
  double elevation_at(const AxisPoint& time, const AxisPoint& a, const AxisPoint& b) const;
  double elevation_at(const AxisPoint& time, double x, double y) const {
    return elevation_at(time, axes.a.point(x), axes.b.point(along_b_of(x, y)));
  }
  void weigh_height(const StretchedHeight& height, Heights& out) const;
  Flow flow(const table::AtHeight& parts) const;
  Kinematics at(const Eigen::Vector3d& point, Now& now) const;
};

/// Polynomials at one height, and their first and second derivatives.
struct TabulatedField::Content::Heights {
  std::vector<double> value, slope, bend;

  void resize(std::size_t levels) {
    for (auto* one : {&value, &slope, &bend}) one->resize(levels);
  }
};

namespace {

/// Amplitudes of the harmonics divided by the windows' transforms, and their wavenumbers along the axes.
struct Prepared {
  Eigen::VectorXcd amplitude;
  Eigen::ArrayXd ka, kb;

  /// At one station.
  Eigen::VectorXcd at(double a, double b) const {
    const Eigen::ArrayXd angle = -(ka * a + kb * b);
    Eigen::VectorXcd out(angle.size());
    for (Eigen::Index j = 0; j < angle.size(); ++j) out[j] = amplitude[j] * std::polar(1.0, angle[j]);
    return out;
  }
};

Prepared prepared(const HarmonicField& field, const BinBand& band, const Axes& axes, Complex Harmonic::*member) {
  const auto count = static_cast<Eigen::Index>(field.harmonics().size());
  Prepared out{Eigen::VectorXcd(count), Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const Harmonic& w = field.harmonics()[static_cast<std::size_t>(j)];
    out.ka[j] = along_a(w, band);
    out.kb[j] = along_b(w, band);
    out.amplitude[j] =
        w.*member / (axes.time.transform(w.omega) * axes.a.transform(out.ka[j]) * axes.b.transform(out.kb[j]));
  }
  return out;
}

std::vector<double> frequencies(const HarmonicField& field) {
  std::vector<double> out;
  for (const Harmonic& w : field.harmonics()) out.push_back(w.omega);
  return out;
}

// Shape (time, a, row).
std::vector<double> elevation_table(const HarmonicField& field, const BinBand& band, const Axes& axes,
                                    std::size_t row) {
  const auto omega = frequencies(field);
  std::vector<double> out(axes.time.count * axes.a.count * row, 0.0);
  const Prepared waves = prepared(field, band, axes, &Harmonic::elevation);
  Eigen::MatrixXcd c(static_cast<Eigen::Index>(axes.b.count), static_cast<Eigen::Index>(omega.size()));
  for (std::size_t ia = 0; ia < axes.a.count; ++ia) {
    for (std::size_t ib = 0; ib < axes.b.count; ++ib)
      c.row(static_cast<Eigen::Index>(ib)) = waves.at(axes.a.at(ia), axes.b.at(ib)).transpose();
    const auto made = synthesise(omega, {axes.time.step, axes.time.count, axes.time.origin}, c).series;
    for (std::size_t n = 0; n < axes.time.count; ++n)
      for (std::size_t ib = 0; ib < axes.b.count; ++ib)
        out[(n * axes.a.count + ia) * row + ib] = made(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(ib));
  }
  return out;
}

/// Sums of waves over the instants of a table, Re Σ_j c_qj a_j e^{iω_j t_n}: real c for all levels q, and complex a of
/// one station. Few instants as a product of matrices, many by transforms.
class SumsOverTime {
 public:
  /// `c`: (levels in whole packs, waves)
  SumsOverTime(std::vector<double> omega, const Axis& time, Eigen::MatrixXd c)
      : omega_(std::move(omega)), time_{time.step, time.count, time.origin}, c_(std::move(c)) {
    if (table::by_product(static_cast<double>(time.count)) > table::by_transform) return;
    constexpr auto four = static_cast<Eigen::Index>(table::instants_at_once);
    const Eigen::Index groups = (static_cast<Eigen::Index>(time.count) + four - 1) / four;
    cosine_.resize(four * c_.cols(), groups);
    sine_.resize(four * c_.cols(), groups);
    for (Eigen::Index g = 0; g < groups; ++g)
      for (Eigen::Index k = 0; k < cosine_.rows(); ++k) {
        const double angle =
            omega_[static_cast<std::size_t>(k / four)] * time.at(static_cast<std::size_t>(four * g + k % four));
        cosine_(k, g) = std::cos(angle);
        sine_(k, g) = std::sin(angle);
      }
    room_.resize(cosine_.rows());
    out_.resize(c_.rows(), four * groups);
    c_ = packs_together(c_);
  }

  /// (levels, at least all instants)
  const Eigen::MatrixXd& of(const Eigen::VectorXcd& a) {
    if (cosine_.size() == 0) {
      out_ = synthesise(omega_, time_, c_ * a.asDiagonal()).series.transpose();
      return out_;
    }
    for (Eigen::Index g = 0; g < cosine_.cols(); ++g)
      table::sum_waves(c_.data(), static_cast<std::size_t>(c_.rows()), static_cast<std::size_t>(c_.cols()), a.data(),
                       cosine_.col(g).data(), sine_.col(g).data(), room_.data(),
                       out_.col(static_cast<Eigen::Index>(table::instants_at_once) * g).data());
    return out_;
  }

 private:
  /// The same numbers, all waves of one pack of levels before those of the next.
  static Eigen::MatrixXd packs_together(const Eigen::MatrixXd& c) {
    constexpr auto pack = static_cast<Eigen::Index>(simd::lanes);
    Eigen::MatrixXd out(c.rows(), c.cols());
    for (Eigen::Index q = 0; q < c.rows(); q += pack)
      for (Eigen::Index j = 0; j < c.cols(); ++j)
        out.reshaped().segment(q * c.cols() + pack * j, pack) = c.col(j).segment(q, pack);
    return out;
  }

  std::vector<double> omega_;
  TimeGrid time_;
  Eigen::MatrixXd c_;              // by products: in the order in which sum_waves() reads them
  Eigen::MatrixXd cosine_, sine_;  // of ω_j t_n, (four instants of each wave, groups of four); empty by transforms
  Eigen::VectorXd room_;
  Eigen::MatrixXd out_;
};

// Shape (time, a, b, levels): Chebyshev coefficients of the potential.
std::vector<double> potential_table(const HarmonicField& field, const BinBand& band, const Axes& axes,
                                    const VerticalBasis& vertical) {
  const auto omega = frequencies(field);
  const auto levels = static_cast<Eigen::Index>(vertical.count()), waves = static_cast<Eigen::Index>(omega.size());
  const std::size_t station = vertical.padded(), instant = axes.a.count * axes.b.count * station;
  Eigen::MatrixXd profile = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(station), waves);
  for (Eigen::Index j = 0; j < waves; ++j) {
    const Harmonic& w = field.harmonics()[static_cast<std::size_t>(j)];
    const double kappa = std::hypot(w.kx, w.ky);
    if (kappa == 0) {  // without a wave vector there is no flow, but a pressure at every height
      profile(0, j) = 1;
      continue;
    }
    const auto one = vertical.profile(kappa, field.water().depth.metres());
    profile.col(j).head(levels) = Eigen::Map<const Eigen::VectorXd>(one.data(), levels);
  }
  const Prepared flow = prepared(field, band, axes, &Harmonic::potential);
  SumsOverTime sums(omega, axes.time, std::move(profile));
  std::vector<double> out(axes.time.count * instant);
  for (std::size_t ia = 0; ia < axes.a.count; ++ia)
    for (std::size_t ib = 0; ib < axes.b.count; ++ib) {
      const Eigen::MatrixXd& made = sums.of(flow.at(axes.a.at(ia), axes.b.at(ib)));
      double* to = out.data() + (ia * axes.b.count + ib) * station;
      for (std::size_t n = 0; n < axes.time.count; ++n, to += instant)
        std::copy_n(made.col(static_cast<Eigen::Index>(n)).data(), station, to);
    }
  return out;
}

// The highest elevation on the nodes inside the box; between nodes that are twice as dense as needed a function may be
// 1/cos(π/4) times as high along each axis.
double highest_crest(const std::vector<double>& elevation, const Axes& axes, const table::Strides& stride) {
  const auto nodes = [](const Axis& axis) {
    std::vector<AxisPoint> out;
    for (std::size_t i = 0; i < axis.count; ++i)
      out.push_back(axis.point(std::min(axis.low + static_cast<double>(i) * axis.step, axis.high)));
    return out;
  };
  const auto a_nodes = nodes(axes.a), b_nodes = nodes(axes.b);
  double highest = 0;
  for (const AxisPoint& time : nodes(axes.time))
    for (const AxisPoint& a : a_nodes)
      for (const AxisPoint& b : b_nodes) {
        const double* from = elevation.data() + static_cast<std::size_t>(time.first) * stride.time +
                             static_cast<std::size_t>(a.first) * stride.a + static_cast<std::size_t>(b.first);
        highest = std::max(highest, std::abs(table::contract_elevation(from, stride, time.view(), a.view(), b.view())));
      }
  return highest * (axes.a.count > 1 ? 2 * std::numbers::sqrt2 : 2);
}

double bytes_of(const Axes& axes, std::size_t row, std::size_t levels) {
  return 8.0 * static_cast<double>(axes.time.count) * static_cast<double>(axes.a.count) *
         (static_cast<double>(row) + static_cast<double>(axes.b.count) * static_cast<double>(levels));
}

void require_memory(const Axes& axes, std::size_t row, std::size_t levels, std::size_t largest) {
  if (const double bytes = bytes_of(axes, row, levels); bytes > static_cast<double>(largest))
    throw InputError(
        fmt::format("a table of {} instants, {} × {} stations and {} levels takes {:.3g} MB, more than the "
                    "{:.3g} MB allowed",
                    axes.time.count, axes.a.count, axes.b.count, levels, bytes / 1e6,
                    static_cast<double>(largest) / 1e6),
        {}, "take a smaller box, one table for each part of the record, or leave out the shortest waves");
}

}  // namespace

double TabulatedField::expected_bytes(const HarmonicField& field, const FieldBox& box, const Options& options) {
  require_box(box, field.water().depth.metres());
  const BinBand band = band_of(field);
  const Window window = Window::of_tolerance(options.tolerance / 4, oversampling);
  const Axes axes = axes_of(window, band, box);
  const double crest = std::min(sum_of(field, &Harmonic::elevation), 8 * rms_elevation(field));
  const std::size_t levels =
      options.elevation_only ? 0 : vertical_basis(field, box, band, crest, options.tolerance / 4).padded();
  return bytes_of(axes, padded(axes.b.count + Window::stride), levels);
}

TabulatedField::TabulatedField(const HarmonicField& field, const FieldBox& box, const Options& options) {
  const double depth = field.water().depth.metres();
  require_box(box, depth);
  require(options.tolerance >= 1e-11 && options.tolerance <= 1e-2,
          "the tolerance of a table must lie between 1e-11 and 1e-2, got {}", options.tolerance);
  Content c{.around = {field.water(), field.options(), field.current()},
            .box = box,
            .band = band_of(field),
            .window = Window::of_tolerance(options.tolerance / 4, oversampling),
            .axes = {},
            .vertical = {},
            .elevation = {},
            .potential = {}};
  auto content = std::make_unique<Content>(std::move(c));
  content->axes = axes_of(content->window, content->band, box);  // points at the window where it stays
  const Axes& axes = content->axes;
  content->row = padded(axes.b.count + Window::stride);
  require_memory(axes, content->row, options.elevation_only ? 0 : 8, options.largest_bytes);
  content->elevation = elevation_table(field, content->band, axes, content->row);
  content->relative_error = (axes.a.count > 1 ? 3 : 2) * content->window.error(std::numbers::pi / oversampling);
  if (options.elevation_only) {
    content->bound = elevation_bound(field, content->relative_error);
    content_ = std::move(content);
    return;
  }
  const double crest = std::min(sum_of(field, &Harmonic::elevation),
                                highest_crest(content->elevation, axes, content->elevation_strides()));
  content->vertical.emplace(vertical_basis(field, box, content->band, crest, options.tolerance / 4));
  require_memory(axes, content->row, content->vertical->padded(), options.largest_bytes);
  content->potential = potential_table(field, content->band, axes, *content->vertical);
  content->relative_error += content->vertical->error();
  content->bound = bounds(field, content->band, content->vertical->top(), content->relative_error, box, crest);
  content_ = std::move(content);
}
TabulatedField::~TabulatedField() = default;
TabulatedField::TabulatedField(TabulatedField&&) noexcept = default;
TabulatedField& TabulatedField::operator=(TabulatedField&&) noexcept = default;

const FieldBox& TabulatedField::box() const noexcept { return content_->box; }
std::size_t TabulatedField::bytes() const noexcept {
  return sizeof(double) * (content_->elevation.size() + content_->potential.size());
}
double TabulatedField::relative_error() const noexcept { return content_->relative_error; }
const FieldError& TabulatedField::error_bound() const noexcept { return content_->bound; }
const Water& TabulatedField::water() const noexcept { return content_->around.water; }

void TabulatedField::Content::require_inside(double t, double x, double y) const {
  if (!axes.time.holds(t))
    throw InputError(
        fmt::format("the table of waves runs from {} s to {} s, asked for {} s", box.start_s, box.end_s, t), {},
        "build the table for the whole run");
  const double slack = 1e-9 * axes.b.step;
  if (!(x >= box.low.x() - slack && x <= box.high.x() + slack && y >= box.low.y() - slack && y <= box.high.y() + slack))
    throw InputError(fmt::format("the table of waves covers x from {} m to {} m and y from {} m to {} m, asked for "
                                 "({}, {}) m",
                                 box.low.x(), box.high.x(), box.low.y(), box.high.y(), x, y),
                     {}, "build the table for all places that the structure can reach");
}

double TabulatedField::Content::elevation_at(const AxisPoint& time, const AxisPoint& a, const AxisPoint& b) const {
  const table::Strides stride = elevation_strides();
  const double* from = elevation.data() + static_cast<std::size_t>(time.first) * stride.time +
                       static_cast<std::size_t>(a.first) * stride.a + static_cast<std::size_t>(b.first);
  return table::contract_elevation(from, stride, time.view(), a.view(), b.view());
}

// Polynomials at the stretched height; beyond z = 0 the tangent goes on from there.
void TabulatedField::Content::weigh_height(const StretchedHeight& height, Heights& out) const {
  if (!(height.z >= vertical->bottom() - 1e-9 && height.z <= vertical->top() + 1e-9))
    throw InputError(fmt::format("the table of waves was built for profiles from z = {} m to {} m, needed at {} m",
                                 vertical->bottom(), vertical->top(), height.z),
                     {}, "build it for a higher box");
  vertical->at(height.z, out.value, out.slope);
  if (height.tangent == 0) return;
  vertical->bend_at(height.z, out.value, out.slope, out.bend);
  for (std::size_t q = 0; q < vertical->padded(); ++q) {
    out.value[q] += height.tangent * out.slope[q];
    out.slope[q] += height.tangent * out.bend[q];
  }
}

Flow TabulatedField::Content::flow(const table::AtHeight& parts) const {
  using namespace table;
  const auto& [plain, by_a, by_aa] = parts;
  // ∂x = ∂a where the axes are x and y; in a long-crested sea a is not there and b lies along the waves.
  const double bx = band.long_crested ? band.along.x() : 0, by = band.along.y(), ax = band.long_crested ? 0 : 1;
  return {.ux = ax * by_a[phi] + bx * plain[phi_b],
          .uy = by * plain[phi_b],
          .uz = plain[phi_z],
          .ax = ax * by_a[rate] + bx * plain[rate_b],
          .ay = by * plain[rate_b],
          .az = plain[rate_z],
          .potential_rate = plain[rate],
          .xx = ax * by_aa[phi] + bx * bx * plain[phi_bb],
          .yy = by * by * plain[phi_bb],
          .xy = ax * by * by_a[phi_b] + bx * by * plain[phi_bb],
          .xz = ax * by_a[phi_z] + bx * plain[phi_bz],
          .yz = by * plain[phi_bz]};
}

double TabulatedField::elevation(double t, double x, double y) const {
  content_->require_inside(t, x, y);
  return content_->elevation_at(content_->axes.time.point(t), x, y);
}

void TabulatedField::elevations(double t, std::span<const Eigen::Vector2d> at, std::span<double> out) const {
  require(at.size() == out.size(), "{} places need as many for the answer, got {}", at.size(), out.size());
  const AxisPoint time = content_->axes.time.point(t);
  for (std::size_t i = 0; i < at.size(); ++i) {
    content_->require_inside(t, at[i].x(), at[i].y());
    out[i] = content_->elevation_at(time, at[i].x(), at[i].y());
  }
}

Kinematics TabulatedField::at(double t, const Eigen::Vector3d& point) const {
  Kinematics out;
  at(t, {&point, 1}, {&out, 1});
  return out;
}

void TabulatedField::Content::require_flow(double z) const {
  require(vertical.has_value(), "this table of waves holds the elevation only");
  if (!(z >= box.low.z() - 1e-9 && z <= box.high.z() + 1e-9))
    throw InputError(
        fmt::format("the table of waves covers z from {} m to {} m, asked for {} m", box.low.z(), box.high.z(), z), {},
        "build the table for all heights that the structure can reach");
}

/// The elevation at all stations at one instant, the potential and its rate: interpolated in time where a station is
/// asked for. Each thread keeps one, since members and iterations ask for the same instant again and again.
class TabulatedField::Content::Now {
 public:
  static Now& of_thread() {
    thread_local Now now;
    return now;
  }
  void turn_to(const Content& table, double t) {
    if (table.number == number_ && t == t_) return;
    const std::size_t stations = table.axes.a.count * table.axes.b.count, size = stations * table.vertical->padded();
    number_ = 0;  // until all is there
    if (potential_.size() < size) {
      potential_.resize(size);
      rate_.resize(size);
    }
    elevation_.resize(std::max(elevation_.size(), table.axes.a.count * table.row));
    heights.resize(table.vertical->padded());
    elevation_known_.assign(table.axes.a.count * table.row, false);
    known_.assign(stations, false);
    time_ = table.axes.time.point(t);
    t_ = t;
    number_ = table.number;
  }
  /// The elevation at a place of these weights.
  double elevation(const Content& table, const AxisPoint& a, const AxisPoint& b) {
    const table::Strides stride = table.elevation_strides();
    const double* now = table.elevation.data() + static_cast<std::size_t>(time_.first) * stride.time;
    const std::size_t first = static_cast<std::size_t>(a.first) * stride.a + static_cast<std::size_t>(b.first);
    for (std::size_t i = 0; i < a.count; ++i)
      complete(elevation_known_, first + i * stride.a, b.count, [&](std::size_t from, std::size_t count) {
        table::contract_time(now + from, stride.time, time_.view(), count, elevation_.data() + from);
      });
    constexpr double all = 1;  // the instant is interpolated already
    return table::contract_elevation(elevation_.data() + first, stride, {&all, nullptr, nullptr, 1}, a.view(),
                                     b.view());
  }
  /// What a flow is made of at a place of these weights, read at `heights`.
  void flow(const Content& table, const AxisPoint& a, const AxisPoint& b, table::AtHeight& out) {
    const std::size_t levels = table.vertical->padded();
    const table::Strides stride = table.potential_strides();
    const double* now = table.potential.data() + static_cast<std::size_t>(time_.first) * stride.time;
    const std::size_t first =
        static_cast<std::size_t>(a.first) * table.axes.b.count + static_cast<std::size_t>(b.first);
    for (std::size_t i = 0; i < a.count; ++i)
      complete(known_, first + i * table.axes.b.count, b.count, [&](std::size_t from, std::size_t count) {
        table::contract_time(now + from * levels, stride.time, time_.view(), count * levels,
                             potential_.data() + from * levels, rate_.data() + from * levels);
      });
    table::contract_place(potential_.data() + first * levels, rate_.data() + first * levels, stride, a.view(), b.view(),
                          heights.value.data(), heights.slope.data(), levels, out);
  }
  Heights heights;  // room for the polynomials at one point's height

 private:
  /// Calls contract(from, count) for each stretch of unknown stations among the `count` from `first` on.
  template <class Contract>
  static void complete(std::vector<char>& known, std::size_t first, std::size_t count, const Contract& contract) {
    for (std::size_t from = first, end = first + count; from < end;) {
      std::size_t to = from;
      while (to < end && !known[to]) known[to++] = true;
      if (to > from) contract(from, to - from);
      from = to + 1;
    }
  }

  std::uint64_t number_ = 0;  // of the table; 0: none
  double t_ = 0;
  AxisPoint time_;
  std::vector<char> elevation_known_, known_;
  std::vector<double> elevation_, potential_, rate_;
};

Kinematics TabulatedField::Content::at(const Eigen::Vector3d& p, Now& now) const {
  const AxisPoint a = axes.a.point(p.x()), b = axes.b.point(along_b_of(p.x(), p.y()));
  const double zeta = now.elevation(*this, a, b);
  weigh_height(around.stretched(p.z(), zeta), now.heights);
  table::AtHeight parts;
  now.flow(*this, a, b, parts);
  return around.kinematics(flow(parts), p.z(), zeta);
}

void TabulatedField::at(double t, std::span<const Eigen::Vector3d> points, std::span<Kinematics> out) const {
  require(points.size() == out.size(), "{} points need as many places for the answer, got {}", points.size(),
          out.size());
  if (points.empty()) return;
  const Content& c = *content_;
  c.require_flow(points[0].z());
  c.require_inside(t, points[0].x(), points[0].y());
  Content::Now& now = Content::Now::of_thread();
  now.turn_to(c, t);
  for (std::size_t i = 0; i < points.size(); ++i) {
    c.require_inside(t, points[i].x(), points[i].y());
    c.require_flow(points[i].z());
    out[i] = c.at(points[i], now);
  }
}

}  // namespace hydro::waves
