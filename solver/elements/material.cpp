// The chain of effects around a law.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/material.hpp>

namespace palpate::elements {
namespace {

/// Energy and stress that were asked for at a point already.
struct Said {
  bool yes = false;
  double W = 0;
  materials::Mat3 P;
};

/// The law with its first `count` effects, at a point.
struct Chain {
  const Material& material;
  const effects::Point& point;
  const double* memory;
  int count;
  std::span<Said> said = {};  ///< by the law, and with its first, second … effect; of more than these it is asked again

  materials::Response operator()(const materials::Mat3& F) const {
    if (count >= static_cast<int>(said.size()) || F != point.F) return ask(F);
    Said& known = said[count];
    if (known.yes) return {known.W, known.P, {}};
    materials::Response r = ask(F);
    known = {true, r.W, r.P};
    return r;
  }
  materials::Response ask(const materials::Mat3& F) const {
    if (count == 0) return material.respond(F, point.modulus, point.known, point.learns, point.asked);
    const auto& last = material.effects[count - 1];
    const Chain within{material, point, memory, count - 1, said};
    effects::Point here = point;
    here.F = F;
    return last.effect.stress.respond(within.inner(), here, {memory + last.memory_at, static_cast<std::size_t>(last.memory)}, last.parameters);
  }
  effects::Inner inner() const {
    return {this, [](const void* chain, const materials::Mat3& F) { return (*static_cast<const Chain*>(chain))(F); }};
  }
};

}  // namespace

void Material::add(const effects::Effect& effect, std::vector<double> effect_parameters) {
  const int size = effect.stress.memory(effect_parameters);
  effects.push_back({{effect, std::move(effect_parameters)}, memory(), size});
}

materials::Response Material::respond(const materials::Mat3& F, double modulus, const materials::KnownLaw* known, materials::KnownLaw* learns, materials::Asked asked) const {
  materials::Response r = known ? known->at(F) : law.respond(F, parameters, asked);
  if (learns) learns->learn(F, r, asked);
  if (modulus == 1) return r;
  r.W *= modulus;
  r.P *= modulus;
  if (asked == materials::Asked::all) r.A *= modulus;
  return r;
}

materials::Response Material::respond(const effects::Point& point, const double* memory) const {
  return Chain{*this, point, memory, static_cast<int>(effects.size())}(point.F);
}

/// From the outside in: an effect sees the inner ones with their old memory, and what they said to the outer ones.
void Material::remember(const effects::Point& point, double* memory) const {
  std::array<Said, 8> said;
  for (int i = static_cast<int>(effects.size()) - 1; i >= 0; --i) {
    const auto& effect = effects[i];
    const Chain within{*this, point, memory, i, said};
    effect.effect.stress.remember(within.inner(), point, {memory + effect.memory_at, static_cast<std::size_t>(effect.memory)}, effect.parameters);
  }
}

}  // namespace palpate::elements
