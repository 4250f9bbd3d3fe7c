// Departures from a neo-Hookean, incompressible tissue without a skin or a pre-stress.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <loop/forward/departures.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace palpate::loop {
namespace {

constexpr const char* no_further_terms = "mu2 = 0.0\nalpha2 = 1.0\nmu3 = 0.0\nalpha3 = 1.0\n";  // palpate-solve's Ogden has three

bool has_law(const Tissue& tissue, const char* name) { return tissue.law->name == name; }

void to_neo_hookean(Tissue& tissue, const char* from) {
  if (!has_law(tissue, from)) return;
  tissue.parameters = {tissue.law->shear_modulus(tissue.parameters)};
  tissue.law = &law_named("neo_hookean");
}

double modulus(const Tissue& t) { return t.law->shear_modulus(t.parameters); }

}  // namespace

const std::vector<Departure>& departures() {
  static const std::vector<Departure> list = {
      {"fung_demiray", 5, true, [](Tissue& t, double e) { t.stiffening.exponential += e; },
       [](const Tissue& t) { return t.stiffening.exponential + (has_law(t, "fung_demiray") ? t.parameters[1] : 0); },
       [](Tissue& t) { t.stiffening.exponential = 0, to_neo_hookean(t, "fung_demiray"); }},
      {"mooney_rivlin", 0.9, true, [](Tissue& t, double e) { t.stiffening.second += e; },
       [](const Tissue& t) { return t.stiffening.second + (has_law(t, "mooney_rivlin") ? t.parameters[1] / (t.parameters[0] + t.parameters[1]) : 0); },
       [](Tissue& t) { t.stiffening.second = 0, to_neo_hookean(t, "mooney_rivlin"); }},
      {"yeoh_C20", 5, true, [](Tissue& t, double e) { t.stiffening.square += e; }, [](const Tissue& t) { return t.stiffening.square; },
       [](Tissue& t) { t.stiffening.square = 0; }},
      {"yeoh_C30", 5, true, [](Tissue& t, double e) { t.stiffening.cube += e; }, [](const Tissue& t) { return t.stiffening.cube; },
       [](Tissue& t) { t.stiffening.cube = 0; }},
      {"ogden", 20, true, [](Tissue& t, double e) { t.stiffening.power += e; },
       [](const Tissue& t) { return t.stiffening.power + (has_law(t, "ogden") ? t.parameters[1] - 2 : 0); },
       [](Tissue& t) { t.stiffening.power = 0, to_neo_hookean(t, "ogden"); }},
      {"compressibility", 0.15, false, [](Tissue& t, double e) { t.nu -= e; }, [](const Tissue& t) { return 0.5 - t.nu; }, [](Tissue& t) { t.nu = 0.5; }},
      {"capsule", 100, false, [](Tissue& t, double e) { t.capsule_N_per_mm += e * modulus(t); }, [](const Tissue& t) { return t.capsule_N_per_mm / modulus(t); },
       [](Tissue& t) { t.capsule_N_per_mm = 0; }},
      {"prestress", 2, false, [](Tissue& t, double e) { t.turgor_MPa += e * modulus(t); }, [](const Tissue& t) { return t.turgor_MPa / modulus(t); },
       [](Tissue& t) { t.turgor_MPa = 0; }},
      {"thickness", 1, false, [](Tissue& t, double e) { t.thickness_factor *= 1 + e; }, [](const Tissue& t) { return t.thickness_factor - 1; },
       [](Tissue& t) { t.thickness_factor = 1; }}};
  return list;
}

const Departure& departure_named(const std::string& name) {
  const auto& list = departures();
  return *std::find_if(list.begin(), list.end(), [&](const Departure& d) { return d.name == name; });
}

double amplitude_of(const Departure& departure, const Site& site, const Tissue& tissue, double depth, double share) {
  const double without = elastic_force(site, tissue, depth);
  const auto change = [&](double e) {
    Tissue with = tissue;
    departure.add(with, e);
    return std::abs(elastic_force(site, with, depth) / without - 1);
  };
  double low = 0, high = 1e-6 * departure.most;
  if (change(departure.most) < 0.1 * share) return share;
  while (high < departure.most && change(high) < share) high *= 2;
  high = std::min(high, departure.most);
  for (int i = 0; i < 40 && change(high) > share; ++i) {
    const double middle = 0.5 * (low + high);
    (change(middle) < share ? low : high) = middle;
    if (high - low < 1e-3 * high) break;
  }
  return high;
}

std::string stiffened_material(double mu, int kind, double e) {
  std::ostringstream out;
  out.precision(12);
  out << "[material]\n";
  switch (kind) {
    case 0: out << "law = \"fung_demiray\"\nmu = " << mu << "\nb = " << e << "\n"; break;
    case 1: out << "law = \"mooney_rivlin\"\nC10 = " << mu / 2 * (1 - e / 100) << "\nC01 = " << mu / 2 * e / 100 << "\n"; break;
    case 2: out << "law = \"yeoh\"\nC10 = " << mu / 2 << "\nC20 = " << mu * e << "\nC30 = 0.0\n"; break;
    case 3: out << "law = \"yeoh\"\nC10 = " << mu / 2 << "\nC20 = 0.0\nC30 = " << mu * e << "\n"; break;
    default: out << "law = \"ogden\"\nmu1 = " << mu << "\nalpha1 = " << 2 + e << "\n" << no_further_terms; break;
  }
  return out.str();
}

std::string material_text(const Tissue& tissue) {
  const double mu = tissue.law->shear_modulus(tissue.parameters);
  const Stiffening& s = tissue.stiffening;
  const double of_kind[] = {s.exponential, 100 * s.second, s.square, s.cube, s.power};
  std::ostringstream out;
  out.precision(12);
  for (int kind = 0; kind < 5; ++kind)
    if (of_kind[kind] != 0) out << stiffened_material(mu, kind, of_kind[kind]);
  if (out.str().empty()) {
    out << "[material]\nlaw = \"" << tissue.law->name << "\"\n";
    for (std::size_t i = 0; i < tissue.parameters.size(); ++i) out << tissue.law->parameters[i].name << " = " << tissue.parameters[i] << "\n";
    if (tissue.law->name.starts_with("hooke")) out << "nu = 0.5\n";
    if (tissue.law->name == "ogden") out << no_further_terms;
  }
  if (tissue.nu != 0.5) out << "kappa = " << 2 * mu * (1 + tissue.nu) / (3 * (1 - 2 * tissue.nu)) << "\n";
  if (tissue.turgor_MPa != 0) out << "[[effect]]\nname = \"prestress\"\np_kPa = " << 1e3 * tissue.turgor_MPa << "\n";
  if (tissue.capsule_N_per_mm != 0) out << "[[effect]]\nname = \"capsule\"\nE_h = " << tissue.capsule_N_per_mm << "\n";
  return out.str();
}

}  // namespace palpate::loop
