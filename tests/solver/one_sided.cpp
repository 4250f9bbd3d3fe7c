// The warning that a derivative is of one side because a point is about to slide or to stick: it is there at that coefficient of friction, and not
// a thousandth beside it. Against a tool, and between organs.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include <tests/verify/case_runs.hpp>
#include <tests/verify/organs.hpp>

using namespace palpate;
using namespace palpate::verify;

namespace {

class OneSided : public CaseRuns {
 protected:
  std::string before, after;  ///< of the coefficient, in the case
  TetMesh mesh;

  Settings with(double friction) {
    std::ostringstream number;
    number.precision(17);
    number << friction;
    write(before + number.str() + after, mesh);
    return Settings::read(folder / "case.toml");
  }

  struct Ran {
    std::set<std::size_t> sliding, sticking;  ///< points, at the end
    std::vector<std::string> remarks;
  };
  Ran run(double friction, const std::string& number) {
    const Settings settings = with(friction);
    Case c = read_case(settings, "");
    implicit::NewtonLimits limits;
    limits.tolerance = 1e-11;
    implicit::Equilibrium equilibrium(c.model, 1, limits);
    implicit::State state = implicit::rest_state(c.model);
    std::optional<Sensitivities> sensitivities;
    if (!number.empty()) sensitivities.emplace(settings, "", std::vector{number}, equilibrium, 1);
    Ran ran;
    const double reached = implicit::run_steps(equilibrium, state, c.steps, [](const implicit::Step& step) { EXPECT_EQ(step.cuts, 0); }, [&](const implicit::Accepted& found) {
      ran.sliding.clear();
      ran.sticking.clear();
      const auto& contact = found.equations.contact;
      for (std::size_t i = 0; i < contact.points.size(); ++i)
        if (contact.points[i].pressure > 0) (contact.points[i].slides ? ran.sliding : ran.sticking).insert(i);
      for (const auto& pair : contact.pairs) (pair.law.answer.slides ? ran.sliding : ran.sticking).insert(pair.at);
      if (sensitivities) sensitivities->follow(found.state);
    });
    EXPECT_EQ(reached, c.steps.times.back());
    if (sensitivities) ran.remarks = sensitivities->one_sided();
    return ran;
  }

  /// The largest coefficient up to which a point slides that sticks at `high`, to 1e-9 of it.
  double about_to_slide(double low, double high) {
    const auto stick = run(high, "").sticking;
    const auto all_stick = [&](double friction) {
      const auto sliding = run(friction, "").sliding;
      return std::none_of(sliding.begin(), sliding.end(), [&](std::size_t point) { return stick.contains(point); });
    };
    EXPECT_FALSE(all_stick(low));
    while (high - low > 1e-9 * high) {
      const double middle = (low + high) / 2;
      (all_stick(middle) ? high : low) = middle;
    }
    return low;
  }

  void expect_the_warning(const std::string& number, double low, double high) {
    const double edge = about_to_slide(low, high);
    const auto remarks = run(edge, number).remarks;
    ASSERT_EQ(remarks.size(), 1u) << edge;
    EXPECT_NE(remarks[0].find("d/d(" + number + ") is of one side in 1 step(s): points of contact are about to slide or to stick"), std::string::npos) << remarks[0];
    for (double factor : {0.999, 1.001}) {
      const auto none = run(factor * edge, number).remarks;
      EXPECT_TRUE(none.empty()) << none.front();
    }
  }
};

}  // namespace

TEST_F(OneSided, APointIsAboutToSlideUnderATool) {
  mesh = mesh_of(brick(uniform(-5, 5, 4), uniform(-5, 5, 4), uniform(0, 5, 2)));
  before = "[material]\nlaw = \"neo_hookean\"\nmu = 0.0067\n[base]\nplane = { point_mm = [0.0, 0.0, 0.01], normal = [0.0, 0.0, 1.0] }\n"
           "[tool]\nkind = \"ball\"\nradius_mm = 3.0\naim_mm = [0.3, 0.2, 5.0]\naxis = [0.4, 0.0, -1.0]\ndepth_mm = 0.6\nfriction = ";
  after = "\n[steps]\ncount = 1\n";
  expect_the_warning("tool.friction", 0.15, 0.4);
}

TEST_F(OneSided, APointIsAboutToSlideOnAnotherOrgan) {
  auto model = brick(uniform(-3, 3, 3), uniform(-3, 3, 3), uniform(-2, 0, 1));
  const int lower = model.faces.size();
  append(model, brick(uniform(-2, 2, 2), uniform(-2, 2, 2), uniform(0, 2, 1)));
  mesh = mesh_of(model);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.tet_region[t] = implicit::centroid(model, t).z() < 0 ? 1 : 2;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) mesh.face_region[f] = int(f) < lower ? 1 : 2;
  mesh.region_names = {{1, "lower"}, {2, "upper"}};
  before = "[[material]]\nregion = \"lower\"\nlaw = \"neo_hookean\"\nmu = 0.05\n[[material]]\nregion = \"upper\"\nlaw = \"neo_hookean\"\nmu = 0.0067\n"
           "[base]\nplane = { point_mm = [0.0, 0.0, -1.99], normal = [0.0, 0.0, 1.0] }\n"
           "[[displacement]]\nplane = { point_mm = [0.0, 0.0, 1.99], normal = [0.0, 0.0, -1.0] }\nmotion_mm = [0.012, 0.002, -0.02]\n"
           "[[contact]]\nbetween = [\"lower\", \"upper\"]\nfriction = ";
  after = "\n[steps]\ncount = 1\n";
  expect_the_warning("contact[0].friction", 1.2, 1.6);
}
