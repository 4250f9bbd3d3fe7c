// Scores by projection, and the threshold by bootstrap with noise estimated anew in every draw.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/score.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <loop/methods/parallel.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {

using Eigen::MatrixXd, Eigen::VectorXd;

double structure(const VectorXd& r, const std::vector<int>& lengths) {
  constexpr int stretch = 6;
  double sum = 0;
  int at = 0;
  for (int length : lengths) {
    for (int b = 0; b < length; b += stretch) {
      const int n = std::min(stretch, length - b);
      sum += std::pow(r.segment(at + b, n).sum(), 2) / n;
    }
    at += length;
  }
  return sum;
}

Scores score(const MatrixXd& T, const MatrixXd& S, const VectorXd& r, const std::vector<Candidate>& candidates, const std::vector<Column>& columns,
             const std::vector<int>& lengths) {
  Scores out;
  MatrixXd scaled = T;
  for (int j = 0; j < T.cols(); ++j) scaled.col(j) /= std::max(T.col(j).norm(), 1e-300);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled);
  const MatrixXd Q = MatrixXd(qr.householderQ() * MatrixXd::Identity(T.rows(), std::max<Eigen::Index>(qr.rank(), 1)));
  const VectorXd left = r - Q * (Q.transpose() * r);
  out.directions = S - Q * (Q.transpose() * S);
  out.structure = structure(left, lengths);
  out.lambda.assign(candidates.size(), 0);
  out.best.assign(candidates.size(), -1);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double norm = out.directions.col(j).norm(), before = S.col(j).norm();
    const bool seen = norm > 1e-6 * before && norm > 1e-12;  // else it is a sum of what is fitted already
    out.norm.push_back(seen ? norm : 0);
    out.directions.col(j) *= seen ? 1 / norm : 0;
    const double z = out.directions.col(j).dot(left);
    out.z.push_back(z);
    const int c = columns[j].candidate;
    if (seen && (z > 0 || candidates[c].is_signed()) && z * z > out.lambda[c]) {
      out.lambda[c] = z * z;
      out.best[c] = static_cast<int>(j);
    }
  }
  return out;
}

double NullDistribution::p(int candidate, double value) const {
  const auto& sorted = lambda[candidate];
  const int n = static_cast<int>(sorted.size()), tail = n / 20;
  const double corner = sorted[n - 1 - tail];
  if (value <= corner || tail < 5 || !(corner > 0)) {
    const auto at_least = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
    return std::max<double>(at_least, value > corner ? 1 : at_least) / n;
  }
  double mean = 0;
  for (int i = n - tail; i < n; ++i) mean += std::log(sorted[i] / corner) / tail;
  return static_cast<double>(tail) / n * std::pow(value / corner, -1 / std::max(mean, 1e-6));
}

namespace {

/// A run of the linear picture: its fast-whitened directions and columns, and their products, from which every draw's own covariance
/// follows: Σ⁻¹ = 1 − Z C Zᵀ with C = V½ (1 + V½ ZᵀZ V½)⁻¹ V½ (Woodbury).
struct RunProducts {
  MatrixXd Z, ZZ, ZT, ZS, T, S;
};

struct Draw {
  std::vector<double> lambda;
  double structure;
};

class Draws {
 public:
  explicit Draws(const NullProblem& null) : null_(null) {
    lengths_ = lengths_of(*null.shapes);
    const MatrixXd T = whitened(*null.problem, null.problem->whiteners, *null.T), S = whitened(*null.problem, null.problem->whiteners, *null.S);
    // S less what T explains of it: scores do not change, and small differences stay exact.
    MatrixXd scaled = T;
    const VectorXd size = T.colwise().norm().cwiseMax(1e-300).transpose();
    for (int j = 0; j < T.cols(); ++j) scaled.col(j) /= size(j);
    const MatrixXd explained = size.cwiseInverse().asDiagonal() * scaled.colPivHouseholderQr().solve(S);
    const Stacked left{null.S->data - null.T->data * explained, null.S->rows - null.T->rows * explained};
    const MatrixXd own = S - T * explained;
    for (int j = 0; j < S.cols(); ++j) seen_.push_back(own.col(j).norm() > 1e-6 * S.col(j).norm() && own.col(j).norm() > 1e-12);
    T_rows_ = null.T->rows;
    S_rows_ = left.rows;
    TT_ = T_rows_.transpose() * T_rows_;
    TS_ = T_rows_.transpose() * S_rows_;
    SS_ = S_rows_.colwise().squaredNorm();
    int at = 0;
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
      const Whitener& w = null.problem->whiteners[i];
      const NoiseShape& shape = (*null.shapes)[i];
      RunProducts run{shape.Q * shape.scale.asDiagonal(), {}, {}, {}, null.T->data.middleRows(at, lengths_[i]), left.data.middleRows(at, lengths_[i])};
      for (MatrixXd* x : {&run.Z, &run.T, &run.S}) w.whiten_fast(*x);
      run.ZZ = run.Z.transpose() * run.Z;
      run.ZT = run.Z.transpose() * run.T;
      run.ZS = run.Z.transpose() * run.S;
      TT_ += run.T.transpose() * run.T;
      TS_ += run.T.transpose() * run.S;
      SS_ += run.S.colwise().squaredNorm();
      runs_.push_back(std::move(run));
      NoiseShape drawn = shape;
      drawn.corner.setZero();  // the same in every replicate: an error, not a draw
      truth_.emplace_back(drawn, null.noise);
      at += lengths_[i];
    }
  }

  /// One set without effect: drawn, its noise estimated anew, scored.
  Draw one(std::uint64_t seed) const;

 private:
  static std::vector<int> lengths_of(const std::vector<NoiseShape>& shapes) {
    std::vector<int> lengths;
    for (const NoiseShape& shape : shapes) lengths.push_back(static_cast<int>(shape.Q.rows()));
    return lengths;
  }
  Draw scored(const MatrixXd& TT, const MatrixXd& TS, const Eigen::RowVectorXd& SS, const VectorXd& Te, const VectorXd& Se, const MatrixXd& T, VectorXd e) const;

  const NullProblem& null_;
  std::vector<int> lengths_;
  std::vector<RunProducts> runs_;
  std::vector<Whitener> truth_;
  std::vector<bool> seen_;
  MatrixXd T_rows_, S_rows_, TT_, TS_;
  Eigen::RowVectorXd SS_;
};

Draw Draws::one(std::uint64_t seed) const {
  std::seed_seq words{seed & 0xffffffffu, seed >> 32};
  std::mt19937_64 random(words);
  std::normal_distribution<double> normal;
  std::vector<VectorXd> drawn;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    MatrixXd e = VectorXd(lengths_[i]).unaryExpr([&](double) { return normal(random); });
    truth_[i].colour(e);
    drawn.push_back(e.col(0));
  }
  const Noise noise = estimate_noise(*null_.shapes, drawn, *null_.group, null_.noise.sensor_sd);
  const VectorXd v = Eigen::Map<const VectorXd>(noise.sd.data(), noise.sd.size());
  VectorXd e_rows = VectorXd(T_rows_.rows()).unaryExpr([&](double) { return normal(random); });
  MatrixXd TT = TT_, TS = TS_;
  Eigen::RowVectorXd SS = SS_;
  VectorXd Te = T_rows_.transpose() * e_rows, Se = S_rows_.transpose() * e_rows;
  const int rows = std::accumulate(lengths_.begin(), lengths_.end(), 0);
  MatrixXd T_white(rows, TT.cols());
  VectorXd e_white(rows);
  int at = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const RunProducts& run = runs_[i];
    MatrixXd e = drawn[i];
    null_.problem->whiteners[i].whiten_fast(e);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(v.asDiagonal() * run.ZZ * v.asDiagonal());
    const VectorXd s2 = eigen.eigenvalues().cwiseMax(0);
    const MatrixXd B = (s2.array() + 1).rsqrt().matrix().asDiagonal() * eigen.eigenvectors().transpose() * v.asDiagonal();  // C = BᵀB
    const MatrixXd BT = B * run.ZT, BS = B * run.ZS;
    const VectorXd Be = B * (run.Z.transpose() * e);
    TT -= BT.transpose() * BT;
    TS -= BT.transpose() * BS;
    SS -= BS.colwise().squaredNorm();
    Te += run.T.transpose() * e - BT.transpose() * Be;
    Se += run.S.transpose() * e - BS.transpose() * Be;
    // The symmetric root, for the structure: 1 − Z V½ E f Eᵀ V½ Zᵀ with f = (1 − 1/√(1 + s²))/s², of which B holds 1/√(1 + s²).
    const VectorXd f = s2.unaryExpr([](double x) { return x > 1e-8 ? (std::sqrt(1 + x) - 1) / x : 0.5; });
    const MatrixXd back = v.asDiagonal() * eigen.eigenvectors() * f.asDiagonal();
    T_white.middleRows(at, lengths_[i]) = run.T - run.Z * (back * BT);
    e_white.segment(at, lengths_[i]) = e - run.Z * (back * Be);
    at += lengths_[i];
  }
  return scored(TT, TS, SS, Te, Se, T_white, std::move(e_white));
}

Draw Draws::scored(const MatrixXd& TT, const MatrixXd& TS, const Eigen::RowVectorXd& SS, const VectorXd& Te, const VectorXd& Se, const MatrixXd& T,
                   VectorXd e) const {
  const VectorXd size = TT.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const MatrixXd scaled = size.cwiseInverse().asDiagonal() * TT * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const VectorXd kept = eigen.eigenvalues().unaryExpr([](double x) { return x > 1e-12 ? 1 / x : 0.0; });
  const MatrixXd inverse = size.cwiseInverse().asDiagonal() * eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose() * size.cwiseInverse().asDiagonal();
  const VectorXd x = inverse * Te;
  const MatrixXd of_S = inverse * TS;
  Draw draw{std::vector<double>(null_.candidates->size(), 0.0), structure(e - T * x, lengths_)};
  for (int j = 0; j < SS.size(); ++j) {
    const int c = (*null_.columns)[j].candidate;
    const double square = SS(j) - TS.col(j).dot(of_S.col(j));
    if (!seen_[j] || !(square > 1e-12 * SS(j))) continue;
    const double z = (Se(j) - TS.col(j).dot(x)) / std::sqrt(square);
    if (z > 0 || (*null_.candidates)[c].is_signed()) draw.lambda[c] = std::max(draw.lambda[c], z * z);
  }
  return draw;
}

}  // namespace

NullDistribution null_distribution(const NullProblem& null, int draws, std::uint64_t seed, int threads) {
  const Draws one(null);
  std::vector<Draw> all(draws);
  for_each_index(draws, threads, [&](int d) { all[d] = one.one(seed * 1000003 + d); });
  NullDistribution out;
  const std::size_t count = null.candidates->size();
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<double> values;
    for (const Draw& d : all) values.push_back(d.lambda[c]);
    std::sort(values.begin(), values.end());
    out.lambda.push_back(std::move(values));
  }
  std::vector<double> smallest, structures;
  for (const Draw& d : all) {
    double p = 1;
    for (std::size_t c = 0; c < count; ++c)
      if ((*null.candidates)[c].pruned.empty()) p = std::min(p, out.p(static_cast<int>(c), d.lambda[c]));
    smallest.push_back(p);
    structures.push_back(d.structure);
  }
  std::sort(smallest.begin(), smallest.end());
  std::sort(structures.begin(), structures.end());
  out.threshold_p = smallest[static_cast<std::size_t>(thresholds::level * draws)];
  out.structure_limit = structures[static_cast<std::size_t>((1 - thresholds::level) * draws)];
  return out;
}

}  // namespace palpate::loop
