// The chain of effects around a law.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <solver/elements/material.hpp>

namespace palpate::elements {
namespace {

/// The law with its first `count` effects, at a point.
struct Chain {
  const Material& material;
  const effects::Point& point;
  const double* memory;
  int count;

  materials::Response operator()(const materials::Mat3& F) const {
    if (count == 0) return material.respond(F, point.modulus, point.known, point.learns);
    const auto& last = material.effects[count - 1];
    const Chain within{material, point, memory, count - 1};
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

materials::Response Material::respond(const materials::Mat3& F, double modulus, const materials::KnownLaw* known, materials::KnownLaw* learns) const {
  materials::Response r = known ? known->at(F) : law.respond(F, parameters);
  if (learns) learns->learn(F, r);
  if (modulus == 1) return r;
  r.W *= modulus;
  r.P *= modulus;
  r.A *= modulus;
  return r;
}

materials::Response Material::respond(const effects::Point& point, const double* memory) const {
  return Chain{*this, point, memory, static_cast<int>(effects.size())}(point.F);
}

/// From the outside in: an effect sees the inner ones with their old memory.
void Material::remember(const effects::Point& point, double* memory) const {
  for (int i = static_cast<int>(effects.size()) - 1; i >= 0; --i) {
    const auto& effect = effects[i];
    const Chain within{*this, point, memory, i};
    effect.effect.stress.remember(within.inner(), point, {memory + effect.memory_at, static_cast<std::size_t>(effect.memory)}, effect.parameters);
  }
}

}  // namespace palpate::elements
