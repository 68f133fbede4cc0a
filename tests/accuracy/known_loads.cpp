#include "tests/accuracy/known_loads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough::testing {
namespace {

constexpr double kInextensible = 1e14;

Analysis first_loss() { return analysis_of(AnalysisType::critical, {}); }
Analysis limits(int number) { return path_on({}, number); }

/// Columns on bonded bases: P_n = P_e (n^2 + k / n^2), k = K L^4 / (pi^4 EI), the least over n.
void add_columns_on_bases(std::vector<KnownLoads>& out) {
  const struct {
    double length, EI, k;
  } cases[] = {{1.0, 1.0, 0.0},     {5.0, 100.0, 0.64}, {10.0, 100.0, 3.5}, {2.0, 7.0, 10.0},
               {8.0, 3.0, 20.0},    {1.0, 1.0, 50.0},   {20.0, 1e4, 100.0}, {3.0, 2.0, 250.0},
               {1.0, 50.0, 1000.0}, {6.0, 1e6, 3000.0}, {12.0, 4.0, 2.0e4}, {1.0, 1.0, 1e5}};
  for (const auto& c : cases) {
    double least = 1e300;
    for (int n = 1; n <= 100; ++n) least = std::min(least, n * n + c.k / (n * n));
    const double unit = kPi * kPi * c.EI / (c.length * c.length);
    Model model = straight(c.length, c.EI, kInextensible * c.EI, "xy", "y");
    model.loads = {force_at(at_node("b"), -unit, 0.0)};
    if (c.k > 0.0) model.foundations = {winkler("m", c.k * std::pow(kPi / c.length, 4) * c.EI)};
    out.push_back(
        {"column on base, k " + std::to_string(c.k), model, first_loss(), false, {{false, 0, least}}});
  }
}

/// Columns with one lateral spring, as tests/verification/column_spring_test.cpp (transfer matrix).
void add_columns_with_springs(std::vector<KnownLoads>& out) {
  const Table table("column_discrete_spring_gamma.csv");
  const auto rows = table.rows();
  for (std::size_t i = 7; i < rows.size(); i += 29) {
    const TableRow& row = rows[i];
    const std::string ends = row.text("bc");
    const std::string top = ends == "CF" ? "" : ends == "CC" ? "yr" : "y";
    Model model = straight(1.0, 1.0, kInextensible, ends == "PP" ? "xy" : "xyr", top);
    model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
    model.springs = {{"k", at_member("m", 1.0 - row.number("c_b")), std::array{0.0, 1.0}, row.number("kx"),
                      Reaction::bilateral, 0.0}};
    out.push_back({"column " + ends + " with spring " + row.text("kx") + " at " + row.text("c_b"),
                   model,
                   first_loss(),
                   false,
                   {{false, 0, row.number("Gamma")}}});
  }
}

/// Reissner's column: P (1 - P / EA + P / GA) = P_e.
void add_flexible_columns(std::vector<KnownLoads>& out) {
  const Table table("column_geometrically_exact_buckling.csv");
  for (const TableRow& row : table.rows()) {
    const double EA = row.number("EA_L2_over_EI");
    Model model = straight(1.0, 1.0, std::isinf(EA) ? kInextensible : EA, "xy", "y");
    if (!std::isinf(row.number("GA_L2_over_EI"))) model.sections[0].GA = row.number("GA_L2_over_EI");
    model.loads = {force_at(at_node("b"), -kPi * kPi, 0.0)};
    out.push_back({"Reissner column, EA " + row.text("EA_L2_over_EI") + ", GA " + row.text("GA_L2_over_EI"),
                   model,
                   first_loss(),
                   false,
                   {{false, 0, row.number("Pcr_over_Pe")}}});
  }
}

/// Shallow arches, without base and on one-sided ones (collocation with free ends of contact).
void add_shallow_arches(std::vector<KnownLoads>& out) {
  const Table table("thesis_4_4_arches_tensionless.csv");
  for (const TableRow& row : table.rows()) {
    const double k = row.number("k");
    Model model = arch(20.0, 420.0, 1.4);
    if (k > 0.0) add_soil(model, k, row.text("side") == "out" ? Side::left : Side::right);
    const bool limit = row.text("type") != "bif";
    out.push_back({"shallow arch, base " + row.text("side") + " " + row.text("k"),
                   model,
                   limits(1),
                   k > 0.0,
                   {{limit, 0, row.number("Lam")}},
                   2e-10});
  }
}

/// Deep arches, clamped and hinged (collocation), both limit points; some of them on a base outside.
void add_deep_arches(std::vector<KnownLoads>& out) {
  const Table plain("arch_clamped_hinged_reference.csv");
  std::vector<TableRow> rows;
  for (const TableRow& row : plain.rows())
    if (row.text("type") == "limit") rows.push_back(row);
  const auto stiffness = [](const std::string& text, double EA) {
    if (text == "EA/3.12") return EA / 3.12;
    return text == "inf" ? 1e15 : 100.0 * std::stod(text);
  };
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
    const double EA = stiffness(rows[i].text("EA"), 0.0);
    Model model = arch(rows[i].number("angle_deg"), EA, 1e6, true);
    if (rows[i].text("GA") != "inf") model.sections[0].GA = stiffness(rows[i].text("GA"), EA);
    out.push_back({"deep arch " + rows[i].text("angle_deg") + ", EA " + rows[i].text("EA") + ", GA " +
                       rows[i].text("GA"),
                   model,
                   limits(2),
                   false,
                   {{true, 0, rows[i].number("Lam")}, {true, 1, rows[i + 1].number("Lam")}}});
  }
  const Table based("thesis_4_4_3_arch_tensionless.csv");
  std::string last;
  for (const TableRow& row : based.rows()) {
    const std::string name = "deep arch " + row.text("deg") + " on base " + row.text("k");
    if (std::exchange(last, name) == name) continue;  // the first limit point of each
    Model model = arch(row.number("deg"), 1200.0, 100.0, true);
    add_soil(model, row.number("k"));
    out.push_back({name, model, limits(1), true, {{true, 0, row.number("Lam")}}, 2e-8});
  }
}

/// Half rings under pressure: q R^3 / EI = n^2 - 1 + k / (n^2 - 1), least over n (Levy; Timoshenko and Gere).
void add_pressed_rings(std::vector<KnownLoads>& out) {
  for (const double k : {0.0, 5.0, 20.0, 60.0, 200.0, 1200.0}) {
    double least = 1e300;
    for (int n = 2; n <= 60; ++n) least = std::min(least, n * n - 1 + k / (n * n - 1));
    Model model;
    model.nodes = {{"bottom", 0.0, -1.0}, {"top", 0.0, 1.0}};
    model.sections = {{"s", kInextensible, 1.0, {}}};
    model.members = {{"m", "bottom", "top", "s", ArcCurve{180.0}, false, false}};
    model.supports = {support("bottom", k > 0.0 ? "xr" : "xyr"), support("top", "xr")};
    if (k > 0.0) model.foundations = {winkler("m", k)};
    model.loads = {PressureLoad{"m", 1.0, Side::right, Pattern::proportional}};
    out.push_back(
        {"pressed ring on springs " + std::to_string(k), model, first_loss(), false, {{false, 0, least}}});
  }
}

/// Rings in a medium that only pushes, under their weight (collocation).
void add_rings_in_media(std::vector<KnownLoads>& out) {
  constexpr double kRadius = 10.0;
  constexpr double kEI = 30e3;
  const Table table("thesis_4_5_ring_winkler.csv");
  for (const TableRow& row : table.rows()) {
    Model model;
    model.nodes = {{"bottom", 0.0, -kRadius}, {"top", 0.0, kRadius}};
    model.sections = {{"s", 36e6, kEI, {}}};
    model.members = {{"m", "bottom", "top", "s", ArcCurve{180.0}, false, false}};
    model.supports = {support("bottom", "xr"), support("top", "xr")};
    model.foundations = {one_sided("m", row.number("k") * kEI / std::pow(kRadius, 4), Side::right)};
    model.loads = {DistributedLoad{
        "m", {0.0, -kEI / std::pow(kRadius, 3)}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    out.push_back({"ring in medium " + row.text("k"),
                   model,
                   limits(1),
                   true,
                   {{true, 0, row.number("Lam_limit")}},
                   1e-9});
  }
}

/// Lee's and Williams' frames (collocation).
void add_frames(std::vector<KnownLoads>& out) {
  constexpr double kLength = 120.0;
  const auto lee = [](double EA, std::optional<double> GA) {
    Model model;
    model.nodes = {{"foot", 0.0, 0.0}, {"corner", 0.0, kLength}, {"end", kLength, kLength}};
    model.sections = {{"s", EA, 1.44e7, GA}};
    model.members = {{"column", "foot", "corner", "s", LineCurve{}, false, false},
                     {"beam", "corner", "end", "s", LineCurve{}, false, false}};
    model.supports = {support("foot", "xy"), support("end", "xy")};
    model.loads = {force_at(at_member("beam", 0.2), 0.0, -1000.0)};
    return model;
  };
  out.push_back({"Lee's frame, inextensible",
                 lee(4.32e17, {}),
                 limits(2),
                 false,
                 {{true, 0, 18.55874653948}, {true, 1, -9.42128745387}}});
  out.push_back({"Lee's frame",
                 lee(4.32e7, {}),
                 limits(2),
                 false,
                 {{true, 0, 18.55672753757}, {true, 1, -9.41443155560}}});
  out.push_back({"Lee's frame, shearable",
                 lee(4.32e7, 4.32e7 / 3.12),
                 limits(2),
                 false,
                 {{true, 0, 18.54452709444}, {true, 1, -9.39248964035}}});
  const auto williams = [](std::optional<double> GA) {
    Model model;
    model.nodes = {{"a", -12.943, 0.0}, {"apex", 0.0, 0.386}, {"b", 12.943, 0.0}};
    model.sections = {{"s", 1.885e6, 9.27e3, GA}};
    model.members = {{"left", "a", "apex", "s", LineCurve{}, false, false},
                     {"right", "apex", "b", "s", LineCurve{}, false, false}};
    model.supports = {support("a", "xyr"), support("b", "xyr")};
    model.loads = {force_at(at_node("apex"), 0.0, -1.0)};
    return model;
  };
  out.push_back({"Williams' frame",
                 williams({}),
                 limits(2),
                 false,
                 {{true, 0, 33.8612330164}, {true, 1, 31.2625831309}}});
  out.push_back({"Williams' frame, shearable",
                 williams(1.885e6 / 3.12),
                 limits(2),
                 false,
                 {{true, 0, 33.8385942960}, {true, 1, 31.2270626644}}});
}

/// Numbers of a cell, separated by spaces.
std::vector<double> numbers_of(const std::string& cell) {
  std::istringstream in(cell);
  std::vector<double> out;
  for (double value = 0.0; in >> value;) out.push_back(value);
  return out;
}

/// Columns on foundations and springs of which some react on one side of the axis (buckling_of_columns.py).
void add_columns_on_supports(std::vector<KnownLoads>& out) {
  const Table table("columns_on_supports.csv");
  for (const TableRow& row : table.rows()) {
    const std::string& ends = row.text("ends");
    const std::string top = ends[1] == 'F' ? "" : ends[1] == 'C' ? "yr" : "y";
    Model model = straight(1.0, 1.0, kInextensible, ends[0] == 'P' ? "xy" : "xyr", top);
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    bool contact = false;
    const auto bases = numbers_of(row.text("foundations"));  // from, to, stiffness, side
    for (std::size_t i = 0; i < bases.size(); i += 4) {
      const Side side = bases[i + 3] > 0.0 ? Side::left : Side::right;
      Foundation base = bases[i + 3] == 0.0 ? winkler("m", bases[i + 2]) : one_sided("m", bases[i + 2], side);
      base.id = "base" + std::to_string(i);
      base.range = {bases[i], bases[i + 1]};
      contact = contact || bases[i + 3] != 0.0;
      model.foundations.push_back(base);
    }
    const auto springs = numbers_of(row.text("springs"));  // at, stiffness, side
    for (std::size_t i = 0; i < springs.size(); i += 3) {
      contact = true;
      model.springs.push_back({"spring" + std::to_string(i), at_member("m", springs[i]),
                               std::array{0.0, springs[i + 2]}, springs[i + 1], Reaction::compression_only,
                               0.0});
    }
    out.push_back({"column " + ends + " on [" + row.text("foundations") + "] [" + row.text("springs") + "]",
                   model,
                   first_loss(),
                   contact,
                   {{false, 0, row.number("P")}}});
  }
}

/// Two-parameter foundations: P = P_Winkler + G (column_two_parameter_foundation.csv).
void add_columns_with_shear_layers(std::vector<KnownLoads>& out) {
  const Table table("column_two_parameter_foundation.csv");
  const auto rows = table.rows();
  for (std::size_t i = 6; i < rows.size(); i += 13) {
    const TableRow& row = rows[i];
    const std::string& ends = row.text("bc");
    Model model = straight(1.0, 1.0, kInextensible, ends == "PP" ? "xy" : "xyr", ends == "CC" ? "yr" : "y");
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    model.foundations = {winkler("m", row.number("k1"), kPi * kPi * row.number("k2"))};
    out.push_back({"column " + ends + " on two parameters " + row.text("k1") + ", " + row.text("k2"),
                   model,
                   first_loss(),
                   false,
                   {{false, 0, row.number("lambda")}}});
  }
}

/// Root of a function that changes its sign once between two points, without a pole there.
template <typename Function>
double root_between(double low, double high, const Function& f) {
  const bool rises = f(high) > 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rises ? high : low) = middle;
  }
  return low;
}

/// Portals with a load on each column, u = h sqrt(P / EI), r = beam stiffness over column stiffness
/// (I_b h) / (I_c b). The conditions are those of Timoshenko and Gere (1961, 2.2, 2.4), free of poles:
/// sway with pinned feet u sin u = 6 r cos u, sway with clamped feet u cos u = -6 r sin u; braced with
/// stiffness 2 r of the beam: pinned feet u^2 sin u + 2 r (sin u - u cos u) = 0, clamped feet
/// u (sin u - u cos u) + 2 r (2 - 2 cos u - u sin u) = 0.
void add_portals(std::vector<KnownLoads>& out) {
  constexpr double kHeight = 2.0;
  constexpr double kSpan = 3.0;
  for (const double r : {0.2, 1.0, 6.0}) {
    const struct {
      const char* name;
      const char* feet;
      bool braced;
      double u;
    } cases[] = {
        {"swaying, pinned", "xy", false,
         root_between(1e-3, 0.5 * kPi, [r](double u) { return u * std::sin(u) - 6.0 * r * std::cos(u); })},
        {"swaying, clamped", "xyr", false,
         root_between(0.5 * kPi, kPi, [r](double u) { return u * std::cos(u) + 6.0 * r * std::sin(u); })},
        {"braced, pinned", "xy", true,
         root_between(
             kPi, 1.4302966532 * kPi,
             [r](double u) { return u * u * std::sin(u) + 2.0 * r * (std::sin(u) - u * std::cos(u)); })},
        {"braced, clamped", "xyr", true, root_between(1.4302966532 * kPi, 2.0 * kPi, [r](double u) {
           return u * (std::sin(u) - u * std::cos(u)) + 2.0 * r * (2.0 - 2.0 * std::cos(u) - u * std::sin(u));
         })}};
    for (const auto& c : cases) {
      Model model;
      model.nodes = {{"a", 0.0, 0.0}, {"b", 0.0, kHeight}, {"c", kSpan, kHeight}, {"d", kSpan, 0.0}};
      model.sections = {{"column", kInextensible, 1.0, {}}, {"beam", kInextensible, r * kSpan / kHeight, {}}};
      model.members = {{"left", "a", "b", "column", LineCurve{}, false, false},
                       {"beam", "b", "c", "beam", LineCurve{}, false, false},
                       {"right", "d", "c", "column", LineCurve{}, false, false}};
      model.supports = {support("a", c.feet), support("d", c.feet)};
      if (c.braced) model.supports.push_back(support("b", "x"));
      model.loads = {force_at(at_node("b"), 0.0, -1.0), force_at(at_node("c"), 0.0, -1.0)};
      out.push_back({std::string("portal ") + c.name + ", beam " + std::to_string(r),
                     model,
                     first_loss(),
                     false,
                     {{false, 0, c.u * c.u / (kHeight * kHeight)}}});
    }
  }
}

/// Inextensible circular arches under pressure, R = EI = 1, on bilateral foundations (pressed_arches.py).
void add_pressed_arches(std::vector<KnownLoads>& out) {
  const Table table("pressed_arches.csv");
  for (const TableRow& row : table.rows()) {
    const double half = row.number("half_angle") * kPi / 180.0;
    const std::string fixed = row.text("ends") == "clamped" ? "xyr" : "xy";
    Model model;
    model.nodes = {{"a", -std::sin(half), 0.0}, {"b", std::sin(half), 0.0}};
    model.sections = {{"s", kInextensible, 1.0, {}}};
    model.members = {{"m", "a", "b", "s", ArcCurve{-2.0 * row.number("half_angle")}, false, false}};
    model.supports = {support("a", fixed), support("b", fixed)};
    if (row.number("k") > 0.0) model.foundations = {winkler("m", row.number("k"))};
    model.loads = {PressureLoad{"m", 1.0, Side::left, Pattern::proportional}};
    out.push_back(
        {"pressed arch " + row.text("half_angle") + ", " + row.text("ends") + ", k " + row.text("k"),
         model,
         first_loss(),
         false,
         {{false, 0, row.number("q")}}});
  }
}

/// Arches under a crown load or their weight, and half rings under their weight, R = EI = 1: the first limit
/// point (limits_of_arches.py). Their foundations react on one side.
void add_arches_and_rings(std::vector<KnownLoads>& out) {
  const Table table("arches_and_rings_limits.csv");
  for (const TableRow& row : table.rows()) {
    const double half = row.number("half_angle") * kPi / 180.0;
    const double k = row.number("k");
    const bool is_ring = row.text("shape") == "ring";
    Model model;
    model.sections = {{"s", row.number("EA"), 1.0, {}}};
    if (is_ring) {
      model.nodes = {{"a", 0.0, -1.0}, {"b", 0.0, 1.0}};
      model.supports = {support("a", "xr"), support("b", "xr")};
    } else {
      const std::string& ends = row.text("ends");
      model.nodes = {{"a", -std::sin(half), 0.0}, {"b", std::sin(half), 0.0}};
      model.supports = {support("a", ends == "pinned" ? "xy" : "xyr"),
                        support("b", ends == "clamped" ? "xyr" : "xy")};
    }
    const double sweep = row.number("half_angle") * (is_ring ? 1.0 : -2.0);
    model.members = {{"m", "a", "b", "s", ArcCurve{sweep}, false, false}};
    if (k > 0.0) {
      // the outside is on the right of a ring that turns to the left
      const bool left = (row.text("side") == "out") != is_ring;
      model.foundations = {one_sided("m", k, left ? Side::left : Side::right)};
      model.foundations[0].gap = row.number("gap");
      model.foundations[0].range = {row.number("from"), row.number("to")};
      if (row.number("to") < 0.5) {  // the other half of the arch has the same
        model.foundations.push_back(model.foundations[0]);
        model.foundations[1].id = "other half";
        model.foundations[1].range = {1.0 - row.number("to"), 1.0 - row.number("from")};
      }
    }
    if (row.text("load") == "crown")
      model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    else
      model.loads = {
          DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    out.push_back({row.text("shape") + " " + row.text("half_angle") + ", " + row.text("ends") + ", " +
                       row.text("load") + ", EA " + row.text("EA") + ", k " + row.text("k") + " " +
                       row.text("side") + ", gap " + row.text("gap") + ", from " + row.text("from"),
                   model,
                   limits(1),
                   k > 0.0,
                   {{true, 0, row.number("limit")}}});
  }
}

}  // namespace

std::vector<KnownLoads> known_loads() {
  std::vector<KnownLoads> out;
  add_columns_on_bases(out);
  add_columns_with_springs(out);
  add_flexible_columns(out);
  add_shallow_arches(out);
  add_deep_arches(out);
  add_pressed_rings(out);
  add_rings_in_media(out);
  add_frames(out);
  add_columns_on_supports(out);
  add_columns_with_shear_layers(out);
  add_portals(out);
  add_pressed_arches(out);
  add_arches_and_rings(out);
  return out;
}

const CriticalPoint* point_of(const Result& result, const KnownLoads::Load& load) {
  int number = 0;
  for (const CriticalPoint& point : result.critical_points)
    if ((point.type != CriticalType::bifurcation) == load.limit && number++ == load.number) return &point;
  return nullptr;
}

}  // namespace snapthrough::testing
