// MUMPS 5 (Amestoy, Duff, L'Excellent, Koster 2001, SIAM J. Matrix Anal. Appl. 23:15), sequential, over a threaded BLAS.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/implicit/sparse_direct.hpp>

#include <cblas.h>
#include <dmumps_c.h>

#include <new>
#include <stdexcept>
#include <string>

namespace palpate::implicit {
namespace {

/// Below this size the fronts are too small for a threaded BLAS: its threads wait for each other longer than they work.
constexpr int threaded_from = 40000;
/// Operations of a factorisation in the time that a solution takes for one entry of the factor.
constexpr double operations_per_entry = 40;

}  // namespace

struct SparseDirect::Mumps {
  DMUMPS_STRUC_C id{};
  std::vector<int> rows, columns;
  std::vector<double> values;

  int& icntl(int i) { return id.icntl[i - 1]; }
  int infog(int i) const { return id.infog[i - 1]; }

  void call(int job) {
    id.job = job;
    dmumps_c(&id);
  }
  /// INFOG(1): −9, −13 and their kin are memory; −10 and −6 a singular matrix; the rest are ours.
  [[noreturn]] void fail() const {
    if (infog(1) == -9 || infog(1) == -13 || infog(1) == -19) throw std::bad_alloc();
    throw std::logic_error("MUMPS INFOG(1) = " + std::to_string(infog(1)) + ", INFOG(2) = " + std::to_string(infog(2)));
  }
};

SparseDirect::SparseDirect(int unknowns, std::vector<int> rows, std::vector<int> columns, bool symmetric, int threads)
    : mumps_(std::make_unique<Mumps>()) {
  openblas_set_num_threads(unknowns < threaded_from ? 1 : threads);
  Mumps& m = *mumps_;
  m.rows = std::move(rows);
  m.columns = std::move(columns);
  m.values.assign(m.rows.size(), 0.0);
  m.id.par = 1;
  m.id.sym = symmetric ? 2 : 0;
  m.id.comm_fortran = -987654;   // MPI_COMM_WORLD of the sequential library
  m.call(-1);
  for (int stream : {1, 2, 3, 4}) m.icntl(stream) = stream == 4 ? 0 : -1;  // silent
  m.icntl(7) = 4;    // PORD; told METIS, Debian's MUMPS takes SCOTCH, which orders a large pattern differently in every run
  m.icntl(12) = 1;   // ordering of the pattern alone; the default would weigh values, which are not known yet, for most of the time
  m.icntl(27) = 32;  // right-hand sides at a time
  m.icntl(14) = 60;  // per cent of extra workspace for pivoting
  m.id.n = unknowns;
  m.id.nnz = static_cast<MUMPS_INT8>(m.rows.size());
  m.id.irn = m.rows.data();
  m.id.jcn = m.columns.data();
  m.id.a = m.values.data();
  m.call(1);
  if (m.infog(1) < 0) m.fail();
}

SparseDirect::~SparseDirect() {
  if (mumps_) mumps_->call(-2);
}
SparseDirect::SparseDirect(SparseDirect&&) noexcept = default;
SparseDirect& SparseDirect::operator=(SparseDirect&& other) noexcept {
  std::swap(mumps_, other.mumps_);
  return *this;
}

bool SparseDirect::factor(const std::vector<double>& values) {
  Mumps& m = *mumps_;
  m.values = values;
  m.id.a = m.values.data();
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
  archive(rows, columns, values);
  if (!archive.reading()) return;
  if (rows != mumps_->rows || columns != mumps_->columns)
    *this = SparseDirect(mumps_->id.n, std::move(rows), std::move(columns), mumps_->id.sym != 0, openblas_get_num_threads());
  factor(values);
}

int SparseDirect::worth() const {
  const double entries = mumps_->infog(20) < 0 ? -1e6 * mumps_->infog(20) : mumps_->infog(20);
  return static_cast<int>(mumps_->id.rinfog[0] / (operations_per_entry * entries));
}

int SparseDirect::negative_pivots() const { return mumps_->infog(12); }

void SparseDirect::solve(Eigen::Ref<Eigen::MatrixXd> right_hand_sides) {
  Mumps& m = *mumps_;
  m.id.nrhs = static_cast<int>(right_hand_sides.cols());
  m.id.lrhs = static_cast<int>(right_hand_sides.outerStride());
  m.id.rhs = right_hand_sides.data();
  m.call(3);
  if (m.infog(1) < 0) m.fail();
}

}  // namespace palpate::implicit
