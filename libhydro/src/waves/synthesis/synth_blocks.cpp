// Blocked phasors (W93): a sum of rotating phasors as a product of two matrices, one of which is the same for all
// blocks of samples and all signals.
#include <algorithm>
#include <array>
#include <vector>

#include "synth_phase.hpp"
#include "synth_series.hpp"
#include "synth_simd.hpp"

namespace hydro::waves::series {
namespace {

using simd::lanes;
using simd::Pack;

constexpr std::size_t chunk = 128;  // components at a time: their table stays in the second-level cache
constexpr std::size_t group = 3;    // blocks at a time: six sums fit into the registers of AVX2

/// Components of one chunk, padded to whole packs: phase of one block as coarse + fine turns.
struct Chunk {
  std::size_t count;
  std::vector<double> coarse, fine;
};

FROUDE_KERNEL void unit_phasors(const double* coarse, const double* fine, std::size_t count, double n, double* sine,
                                double* cosine) {
  for (std::size_t j = 0; j < count; j += lanes) {
    Pack c, f, s, e;
    simd::load(coarse + j, c);
    simd::load(fine + j, f);
    Pack turns = n * c;  // exact (W90)
    turns = turns - ((turns + simd::whole_only) - simd::whole_only) + n * f;
    simd::sincos_turns(turns, s, e);
    simd::store(s, sine + j);
    simd::store(e, cosine + j);
  }
}

// E_m += Σ_j Re d_j cos ω_j τ_m and O_m += Σ_j Im d_j sin ω_j τ_m for `group` columns of d and all m.
// `table`: for each pack of m, for each j: eight cosines, eight sines. `operand`: for each j, real and imaginary part
// of each column. `sums[column]`: E, then O, of `half` values each.
FROUDE_KERNEL void accumulate(const double* table, const double* operand, std::size_t count, std::size_t half,
                              double* const* sums) {
  for (std::size_t m = 0; m < half; m += lanes, table += 2 * lanes * count) {
    Pack e0{}, e1{}, e2{}, o0{}, o1{}, o2{};
    const double* d = operand;
    const double* row = table;
    for (std::size_t j = 0; j < count; ++j, d += 2 * group, row += 2 * lanes) {
      Pack c, s;
      simd::load(row, c);
      simd::load(row + lanes, s);
      e0 += c * d[0];
      o0 += s * d[1];
      e1 += c * d[2];
      o1 += s * d[3];
      e2 += c * d[4];
      o2 += s * d[5];
    }
    const Pack* even[] = {&e0, &e1, &e2};
    const Pack* odd[] = {&o0, &o1, &o2};
    for (std::size_t column = 0; column < group; ++column) {
      Pack sum;
      simd::load(sums[column] + m, sum);
      simd::store(sum + *even[column], sums[column] + m);
      simd::load(sums[column] + half + m, sum);
      simd::store(sum + *odd[column], sums[column] + half + m);
    }
  }
}

// cos and sin of ω_j τ_m at τ_m = (m + ½) dt, in the order in which accumulate reads them.
std::vector<double> phasor_table(std::span<const double> omega, double dt, std::size_t half) {
  const std::size_t count = omega.size(), full = simd::padded(count);
  std::vector<double> coarse(full, 0.0), fine(full, 0.0), sine(full), cosine(full), table(2 * half * count);
  for (std::size_t j = 0; j < count; ++j) {
    const phase::Step step = phase::repeatable(phase::of(omega[j], 0.5 * dt));
    coarse[j] = step.coarse;
    fine[j] = step.fine;
  }
  for (std::size_t m = 0; m < half; ++m) {
    unit_phasors(coarse.data(), fine.data(), full, static_cast<double>(2 * m + 1), sine.data(), cosine.data());
    double* pack = table.data() + m / lanes * 2 * lanes * count + m % lanes;
    for (std::size_t j = 0; j < count; ++j, pack += 2 * lanes) {
      pack[0] = cosine[j];
      pack[lanes] = sine[j];
    }
  }
  return table;
}

// E and O become the samples on both sides of the block's centre: x(t_c ± τ) = E ∓ O.
void unfold(const double* sums, std::size_t half, std::size_t wanted, double* out) {
  const double* even = sums;
  const double* odd = sums + half;
  for (std::size_t n = 0; n < std::min(half, wanted); ++n) out[n] = even[half - 1 - n] + odd[half - 1 - n];
  for (std::size_t n = half; n < wanted; ++n) out[n] = even[n - half] - odd[n - half];
}

/// One chunk of components, added to the sums of all signals and blocks.
class ChunkSum {
 public:
  ChunkSum(const Task& task, std::size_t first, std::size_t count, std::size_t half)
      : task_(task), first_(first), count_(count), half_(half) {
    const auto omega = task.omega.subspan(first, count);
    table_ = phasor_table(omega, task.dt, half);
    const std::size_t full = simd::padded(count);
    coarse_.assign(full, 0.0);
    fine_.assign(full, 0.0);
    // Block b is centred at (2b + 1)·half − ½ steps, that is, at a start plus b whole blocks.
    for (std::size_t j = 0; j < count; ++j) {
      const phase::Step step = phase::repeatable(phase::of(omega[j], 2 * static_cast<double>(half) * task.dt));
      coarse_[j] = step.coarse;
      fine_[j] = step.fine;
      start_.push_back(phase::unit(phase::of(omega[j], (static_cast<double>(half) - 0.5) * task.dt)));
    }
    for (std::size_t g = 0; g < group; ++g) sine_[g].resize(full), cosine_[g].resize(full);
    operand_.resize(2 * group * count);
  }

  /// `sums(signal, block)` is where E and O of that block are gathered.
  template <class Sums>
  void add(std::size_t blocks, const Sums& sums) {
    for (std::size_t b = 0; b < blocks; b += group) {
      for (std::size_t g = 0; g < group; ++g)
        unit_phasors(coarse_.data(), fine_.data(), coarse_.size(), static_cast<double>(b + g), sine_[g].data(),
                     cosine_[g].data());
      for (Eigen::Index s = 0; s < task_.amplitudes.rows(); ++s) {
        fill_operand(s);
        std::array<double*, group> to{};
        for (std::size_t g = 0; g < group; ++g) to[g] = sums(s, b + g);
        accumulate(table_.data(), operand_.data(), count_, half_, to.data());
      }
    }
  }

 private:
  void fill_operand(Eigen::Index s) {
    double* d = operand_.data();
    for (std::size_t j = 0; j < count_; ++j) {
      const std::complex<double> c = task_.amplitudes(s, static_cast<Eigen::Index>(first_ + j)) * start_[j];
      for (std::size_t g = 0; g < group; ++g, d += 2) {
        d[0] = c.real() * cosine_[g][j] - c.imag() * sine_[g][j];
        d[1] = c.real() * sine_[g][j] + c.imag() * cosine_[g][j];
      }
    }
  }
  const Task& task_;
  std::size_t first_, count_, half_;
  std::vector<double> table_, coarse_, fine_, operand_;
  std::vector<std::complex<double>> start_;
  std::array<std::vector<double>, group> sine_, cosine_;
};

}  // namespace

std::size_t half_block(std::size_t samples) { return samples >= 16384 ? 128 : samples >= 192 ? 32 : 8; }

void blocked_phasors(const Task& task, Eigen::MatrixXd& out) {
  const std::size_t half = half_block(task.samples), block = 2 * half;
  const std::size_t blocks = (task.samples + block - 1) / block, padded = (blocks + group - 1) / group * group;
  const auto signals = static_cast<std::size_t>(task.amplitudes.rows());
  std::vector<double> sums(signals * padded * block, 0.0);
  const auto place = [&](Eigen::Index s, std::size_t b) {
    return &sums[(static_cast<std::size_t>(s) * padded + b) * block];
  };
  for (std::size_t first = 0; first < task.omega.size(); first += chunk)
    ChunkSum(task, first, std::min(chunk, task.omega.size() - first), half).add(padded, place);
  for (Eigen::Index s = 0; s < out.cols(); ++s)
    for (std::size_t b = 0; b < blocks; ++b)
      unfold(place(s, b), half, std::min(block, task.samples - b * block), out.col(s).data() + b * block);
}

}  // namespace hydro::waves::series
