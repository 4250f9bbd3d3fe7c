// MUMPS 5 (Amestoy, Duff, L'Excellent, Koster 2001, SIAM J. Matrix Anal. Appl. 23:15), sequential, over a threaded BLAS.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/sparse_direct.hpp>

#include <cblas.h>
#include <dmumps_c.h>
#include <smumps_c.h>

#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include <solver/implicit/ordering.hpp>

namespace palpate::implicit {
namespace {

/// Below this size the fronts are too small for a threaded BLAS: its threads wait for each other longer than they work.
constexpr int threaded_from = 40000;
/// Operations of a factorisation in the time that a solution takes for one entry of the factor.
constexpr double operations_per_entry = 40;

/// MUMPS' two structures have the same members.
struct Full {
  DMUMPS_STRUC_C id{};
  std::vector<double> values;
  void call() { dmumps_c(&id); }
};
struct Single {
  SMUMPS_STRUC_C id{};
  std::vector<float> values;
  void call() { smumps_c(&id); }
};

std::variant<Full, Single> engine_of(Precision precision) {
  if (precision == Precision::single) return Single{};
  return Full{};
}

}  // namespace

struct SparseDirect::Mumps {
  explicit Mumps(Precision precision) : engine(engine_of(precision)) {}

  std::variant<Full, Single> engine;
  std::vector<int> rows, columns, order;
  std::vector<double> values;

  template <class Use>
  decltype(auto) with(const Use& use) {
    return std::visit(use, engine);
  }
  int& icntl(int i) {
    return with([i](auto& e) -> int& { return e.id.icntl[i - 1]; });
  }
  int infog(int i) {
    return with([i](auto& e) { return e.id.infog[i - 1]; });
  }
  void call(int job) {
    with([job](auto& e) {
      e.id.job = job;
      e.call();
    });
  }
  /// INFOG(1): −9, −13 and their kin are memory; −10 and −6 a singular matrix; the rest are ours.
  [[noreturn]] void fail() {
    if (infog(1) == -9 || infog(1) == -13 || infog(1) == -19) throw std::bad_alloc();
    throw std::logic_error("MUMPS INFOG(1) = " + std::to_string(infog(1)) + ", INFOG(2) = " + std::to_string(infog(2)));
  }
};

SparseDirect::SparseDirect(int unknowns, std::vector<int> rows, std::vector<int> columns, bool symmetric, int threads, Precision precision)
    : precision_(precision), mumps_(std::make_unique<Mumps>(precision)) {
  openblas_set_num_threads(unknowns < threaded_from ? 1 : threads);
  Mumps& m = *mumps_;
  m.rows = std::move(rows);
  m.columns = std::move(columns);
  m.order = nested_dissection(unknowns, m.rows, m.columns);
  m.with([&](auto& e) {
    e.id.par = 1;
    e.id.sym = symmetric ? 2 : 0;
    e.id.comm_fortran = -987654;  // MPI_COMM_WORLD of the sequential library
  });
  m.call(-1);
  for (int stream : {1, 2, 3, 4}) m.icntl(stream) = stream == 4 ? 0 : -1;  // silent
  m.icntl(7) = 1;    // our ordering; told METIS, Debian's MUMPS takes SCOTCH, which orders a large pattern differently in every run
  m.icntl(12) = 1;   // ordering of the pattern alone; the default would weigh values, which are not known yet, for most of the time
  m.icntl(27) = 32;  // right-hand sides at a time
  m.icntl(14) = 60;  // per cent of extra workspace for pivoting
  m.with([&](auto& e) {
    e.values.assign(m.rows.size(), 0);
    e.id.n = unknowns;
    e.id.nnz = static_cast<MUMPS_INT8>(m.rows.size());
    e.id.irn = m.rows.data();
    e.id.jcn = m.columns.data();
    e.id.perm_in = m.order.data();
    e.id.a = e.values.data();
  });
  m.call(1);
  if (m.infog(1) < 0) m.fail();
}

SparseDirect::~SparseDirect() {
  if (mumps_) mumps_->call(-2);
}
SparseDirect::SparseDirect(SparseDirect&&) noexcept = default;
SparseDirect& SparseDirect::operator=(SparseDirect&& other) noexcept {
  std::swap(precision_, other.precision_);
  std::swap(mumps_, other.mumps_);
  return *this;
}

bool SparseDirect::factor(const std::vector<double>& values) {
  Mumps& m = *mumps_;
  m.values = values;
  m.with([&](auto& e) { e.values.assign(values.begin(), values.end()); });
  for (int attempt = 0; attempt < 4; ++attempt) {
    m.call(2);
    if (m.infog(1) >= 0) return true;
    if (m.infog(1) == -10 || m.infog(1) == -6) return false;
    if (m.infog(1) != -9) m.fail();
    m.icntl(14) *= 2;  // pivoting needed more room than foreseen
  }
  m.fail();
}

void SparseDirect::keep(Archive& archive) {
  std::vector<int> rows = mumps_->rows, columns = mumps_->columns;
  std::vector<double> values = mumps_->values;
  Precision precision = precision_;
  archive(precision, rows, columns, values);
  if (!archive.reading()) return;
  if (precision != precision_ || rows != mumps_->rows || columns != mumps_->columns) {
    const auto [unknowns, symmetric] = mumps_->with([](auto& e) { return std::pair{e.id.n, e.id.sym != 0}; });
    *this = SparseDirect(unknowns, std::move(rows), std::move(columns), symmetric, openblas_get_num_threads(), precision);
  }
  factor(values);
}

int SparseDirect::worth() const {
  const double entries = mumps_->infog(20) < 0 ? -1e6 * mumps_->infog(20) : mumps_->infog(20);
  const double operations = mumps_->with([](auto& e) { return static_cast<double>(e.id.rinfog[0]); });
  return static_cast<int>(operations / (operations_per_entry * entries));
}

int SparseDirect::negative_pivots() const { return mumps_->infog(12); }

void SparseDirect::solve(Eigen::Ref<Eigen::MatrixXd> right_hand_sides) {
  Mumps& m = *mumps_;
  m.with([&](auto& e) {
    using Scalar = typename std::decay_t<decltype(e.values)>::value_type;
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> x = right_hand_sides.template cast<Scalar>();
    e.id.nrhs = static_cast<int>(x.cols());
    e.id.lrhs = static_cast<int>(x.rows());
    e.id.rhs = x.data();
    m.call(3);
    if (m.infog(1) < 0) m.fail();
    right_hand_sides = x.template cast<double>();
  });
}

}  // namespace palpate::implicit
