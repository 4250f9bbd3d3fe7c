// A set searched for what the model lacks, by curves of finite strain, and where these are not enough by those of small strain too.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <loop/methods/search.hpp>

namespace palpate::loop {

/// What the search says with one kind of elastic curve.
struct CurveTried {
  Strains strains = Strains::finite;
  std::vector<std::string> effects;
  double chi2 = 0;
  VerdictKind kind = VerdictKind::nothing_supported;
};

struct Searched {
  Session session;
  Finding finding;
  std::vector<CurveTried> curves;  ///< the one the finding rests on is the first
};

/// Searches with curves of finite strain, which `correct` may have taught what solves said. Closed forms of small strain are what many a published curve was made or fitted with; a
/// set that asks for effects under finite strain is therefore searched with them too (with the layer's exact factor or Dimitriadis' series, whichever leaves less before anything is added), and believed where they explain it as well with fewer effects (within
/// 2 Δℓ = 9.2 and what the shortcuts of those found may be off by), or where finite strain leaves
/// something unexplained, at half its misfit; they are searched for no more effects than that. A change of law that turns the one curve into the other cannot be seen then; the finding's remarks say so. Not asked without replicates, nor of a case.
Searched searched(const Set& set, const std::function<void(Forward&)>& correct, int threads, int null_sets, std::uint64_t seed,
                  const std::function<void(const std::string&)>& remark);

}  // namespace palpate::loop
