// Every effect of the catalogue on a clamped tube: switched off it is the wall without, to the bit; switched on it changes it and the energies balance.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <palpate/errors.hpp>
#include <palpate/text_file.hpp>
#include <solver/explicit/closing.hpp>
#include <tests/words/temporary_folder.hpp>

namespace palpate::explicit_shell {
namespace {

effects::Effect effect_named(const std::string& name) {
  for (const auto& effect : effects::all())
    if (effect.entry.name == name) return effect;
  throw std::runtime_error("no effect " + name);
}

/// A coarse tube, closed at once; what a case file says is read.
class ShellCases : public InFolder, public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    ShellMesh mesh;
    constexpr int around = 16, rings = 9;
    for (int r = 0; r <= rings; ++r)
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * (i + (r % 2) * 0.5) / around;
        mesh.points.push_back({11.8 * std::cos(angle), 11.8 * std::sin(angle), 4.0 * r});
        mesh.end.push_back(r == 0 ? 1 : r == rings ? 2 : 0);
        mesh.end_direction.push_back(r == 0 ? Vec3{0, 0, -1} : r == rings ? Vec3{0, 0, 1} : Vec3{0, 0, 0});
      }
    for (int r = 0; r < rings; ++r)
      for (int i = 0; i < around; ++i) {
        const int a = r * around + i, b = r * around + (i + 1) % around, c = a + around, d = b + around;
        if (r % 2 == 0) mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
        else mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
      }
    mesh.triangle_region.assign(mesh.triangles.size(), 1);
    mesh.region_names = {{1, "wall"}};
    mesh.thickness_mm.assign(mesh.points.size(), 1.4);
    write_shells(folder / "wall.vtu", mesh);
  }

  struct Outcome {
    std::vector<Lanes> x;
    double peak = 0, imbalance = 0;
  };
  Outcome close(const std::string& more) {
    write_text(folder / "case.toml", "schema = \"palpate-case/1\"\nscheme = \"explicit\"\nmesh = \"wall.vtu\"\n[material]\nlaw = \"mooney_rivlin\"\nC10 = 0.083\nC01 = 0.0565\n"
                                     "[clamp]\ncentre_mm = [0, 0, 18]\nspeed_mm_s = 800\ngap_mm = 6\n[steps]\nrows = 10\nframes = 1\n" + more);
    Case c = read_case(folder / "case.toml", "");
    Closing closing(c, 1);
    Outcome out;
    closing.run([&](const Row& r) { out.peak = std::max(out.peak, r.closing_force); }, [](const Row&) {});
    out.x = closing.motion.state.x;
    out.imbalance = closing.worst_imbalance / closing.peak_internal;
    return out;
  }
};

std::string table_of(const effects::Effect& effect, bool off) {
  std::ostringstream out;
  out << "[[effect]]\nname = \"" << effect.entry.name << "\"\n";
  if (effect.force.respond) out << "box = { min_mm = [-20, -20, -1], max_mm = [20, 0, 50] }\n";
  for (std::size_t i = 0; i < effect.entry.parameters.size(); ++i) {
    const auto& p = effect.entry.parameters[i];
    if (off && effects::fallback(effect, i)) continue;
    const double place = p.name == "y_mm" ? 11.8 : p.name == "z_mm" ? 18 : p.typical;
    out << p.name << " = " << (off && i == 0 ? 0 : p.name == "tau_s" ? 0.005 : place) << "\n";
  }
  return out.str();
}

TEST_P(ShellCases, OffIsTheWallWithoutToTheBit) {
  const effects::Effect effect = effect_named(GetParam());
  const Outcome without = close("");
  Outcome off, on;
  try {
    off = close(table_of(effect, true));
    on = close(table_of(effect, false));
  } catch (const Failure& failure) {
    EXPECT_EQ(GetParam(), "rate") << failure.what();  // refused, and said why
    EXPECT_NE(std::string(failure.what()).find("steps would have to be"), std::string::npos) << failure.what();
    return;
  }
  double most = 0, change = 0;
  for (std::size_t i = 0; i < without.x.size(); ++i) {
    most = std::max(most, length3(off.x[i] - without.x[i]));
    change = std::max(change, length3(on.x[i] - without.x[i]));
  }
  EXPECT_EQ(most, 0);
  EXPECT_EQ(off.peak, without.peak);
  EXPECT_GT(change, 1e-4);
  EXPECT_LE(on.imbalance, 0.01);
  std::printf("  peak force %.4f N without, %.4f N with; balance %.1e\n", without.peak, on.peak, on.imbalance);
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto& effect : effects::all()) list.push_back(effect.entry.name);
  return list;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ShellCases, testing::ValuesIn(names()), [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace palpate::explicit_shell
