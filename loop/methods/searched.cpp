// Finite strains first, small ones where effects were asked for.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/methods/searched.hpp>

#include <algorithm>

#include <loop/methods/misfit.hpp>
#include <loop/methods/thresholds.hpp>

namespace palpate::loop {
namespace {

CurveTried tried_of(const Searched& s, Strains strains) {
  CurveTried tried{strains, {}, s.finding.final.chi2, s.finding.kind};
  for (const Active& a : s.finding.final.model.active) tried.effects.push_back(a.effect->entry.name);
  return tried;
}

Session session_of(Strains strains, const Set& set, const std::function<void(Forward&)>& correct, int threads) {
  Session session = prepared(set, [&](Forward& forward) {
    forward.use(strains);
    if (correct) correct(forward);
  });
  session.threads = threads;
  return session;
}

/// Of the two curves of small strain the one that is nearer before anything is added.
std::pair<Strains, Session> nearer_small_strain(const Set& set, int threads) {
  Session exact = session_of(Strains::small, set, {}, threads), series = session_of(Strains::series, set, {}, threads);
  if (series.null.chi2 < exact.null.chi2) return {Strains::series, std::move(series)};
  return {Strains::small, std::move(exact)};
}

/// What is unexplained counts as more effects than the search may take.
int effects_of(const CurveTried& t) { return t.kind == VerdictKind::unexplained ? thresholds::most_effects + 1 : static_cast<int>(t.effects.size()); }

/// How much more, in chi2, a simpler explanation is searched for: what excludes no alternative, and a tenth of what is left, which form errors and the noise's size may make of it.
double margin(const Searched& s) { return 2 * thresholds::alternative + 0.1 * s.finding.final.chi2; }

/// Whether what was found with one curve is not excluded beside what was found with the other: not as fitted, or not when form errors, of which more effects have more, are counted.
bool as_good(const Searched& one, const Searched& other) {
  return one.finding.final.chi2 <= other.finding.final.chi2 + 2 * thresholds::alternative ||
         misfit(one.session, one.finding.final) <= misfit(other.session, other.finding.final) + 2 * thresholds::alternative;
}

/// Squares per block.
double per_block(const Searched& s) {
  int blocks = 0;
  for (std::size_t run : s.session.problem.runs) blocks += s.session.forward->blocks(run);
  return s.finding.final.chi2 / std::max(blocks, 1);
}

}  // namespace

Searched searched(const Set& set, const std::function<void(Forward&)>& correct, int threads, int null_sets, std::uint64_t seed,
                  const std::function<void(const std::string&)>& remark) {
  Searched finite{session_of(Strains::finite, set, correct, threads), {}, {}};
  finite.finding = search(finite.session, null_sets, seed, remark);
  finite.curves.push_back(tried_of(finite, Strains::finite));
  const bool pressed = std::any_of(set.runs.begin(), set.runs.end(), [](const Run& r) { return r.role == Role::fit && r.test == Test::indentation; });
  const VerdictKind kind = finite.finding.kind;
  if (!pressed || !set.specimen.case_file.empty() || set.specimen.shape == "tube" || kind == VerdictKind::nothing_supported || kind == VerdictKind::ranking_only) return finite;
  if (kind == VerdictKind::unexplained && per_block(finite) < thresholds::other_curve) return finite;
  remark("the same with closed forms of small strain");
  auto [strains, session] = nearer_small_strain(set, threads);
  Searched small{std::move(session), {}, {}};
  const int most = effects_of(finite.curves.front()) - 1;
  const double enough = kind == VerdictKind::unexplained ? 0.5 * finite.finding.final.chi2 : finite.finding.final.chi2 + margin(finite);
  if (most == 0 && small.session.null.chi2 > enough) {  // no effect is left out, and without one it explains less
    finite.curves.push_back({strains, {}, small.session.null.chi2, VerdictKind::unexplained});
    return finite;
  }
  small.finding = search(small.session, null_sets, seed, remark, std::min(most, thresholds::most_effects), enough);
  small.curves.push_back(tried_of(small, strains));
  const bool taken = effects_of(small.curves.front()) < effects_of(finite.curves.front()) && small.finding.final.chi2 <= enough && (kind == VerdictKind::unexplained || as_good(small, finite));
  Searched& best = taken ? small : finite;
  best.curves.push_back((taken ? finite : small).curves.front());
  if (taken)
    best.finding.remarks.push_back("the curves are those of small-strain closed forms" + std::string(strains == Strains::series ? " with Dimitriadis' series for the layer" : "") + ", which need fewer effects here than a solid that is solved at finite strain; "
                                   "a stiffening law that makes the one from the other cannot be seen");
  return std::move(best);
}

}  // namespace palpate::loop
