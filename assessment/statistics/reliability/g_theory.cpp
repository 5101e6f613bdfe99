#include "assessment/statistics/reliability/g_theory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/reliability/pivotal_interval.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr double kMostCases = 1e6;

// Scores of persons by cases by occasions, full.
struct Cube {
  std::size_t persons = 0, cases = 0, occasions = 0;
  std::vector<double> values;
  double at(std::size_t p, std::size_t c, std::size_t o) const { return values[(p * cases + c) * occasions + o]; }
};

// Means over what is not kept, of a kept index each.
std::vector<double> means_of(const Cube& cube, bool person, bool of_case, bool occasion) {
  const std::size_t cases = of_case ? cube.cases : 1, occasions = occasion ? cube.occasions : 1;
  std::vector<double> means((person ? cube.persons : 1) * cases * occasions);
  const double each = static_cast<double>(means.size()) / static_cast<double>(cube.values.size());
  for (std::size_t p = 0; p < cube.persons; ++p)
    for (std::size_t c = 0; c < cube.cases; ++c)
      for (std::size_t o = 0; o < cube.occasions; ++o)
        means[((person ? p : 0) * cases + (of_case ? c : 0)) * occasions + (occasion ? o : 0)] +=
            each * cube.at(p, c, o);
  return means;
}

// The mean squares of persons, cases, occasions, their three pairs, and the rest.
struct CubeSquares {
  double p = 0.0, c = 0.0, o = 0.0, pc = 0.0, po = 0.0, co = 0.0, rest = 0.0;
};

CubeSquares mean_squares_of(const Cube& cube) {
  const double np = static_cast<double>(cube.persons), nc = static_cast<double>(cube.cases),
               no = static_cast<double>(cube.occasions);
  const auto p = means_of(cube, true, false, false), c = means_of(cube, false, true, false),
             o = means_of(cube, false, false, true), pc = means_of(cube, true, true, false),
             po = means_of(cube, true, false, true), co = means_of(cube, false, true, true);
  const double all = means_of(cube, false, false, false).front();
  CubeSquares sums;
  for (std::size_t i = 0; i < cube.persons; ++i)
    for (std::size_t j = 0; j < cube.cases; ++j)
      for (std::size_t k = 0; k < cube.occasions; ++k) {
        const double ij = pc[i * cube.cases + j], ik = po[i * cube.occasions + k], jk = co[j * cube.occasions + k];
        const auto add = [](double& sum, double off) { sum += off * off; };
        add(sums.p, p[i] - all);
        add(sums.c, c[j] - all);
        add(sums.o, o[k] - all);
        add(sums.pc, ij - p[i] - c[j] + all);
        add(sums.po, ik - p[i] - o[k] + all);
        add(sums.co, jk - c[j] - o[k] + all);
        add(sums.rest, cube.at(i, j, k) - ij - ik - jk + p[i] + c[j] + o[k] - all);
      }
  sums.p /= np - 1.0;
  sums.c /= nc - 1.0;
  sums.o /= no - 1.0;
  sums.pc /= (np - 1.0) * (nc - 1.0);
  sums.po /= (np - 1.0) * (no - 1.0);
  sums.co /= (nc - 1.0) * (no - 1.0);
  sums.rest /= (np - 1.0) * (nc - 1.0) * (no - 1.0);
  return sums;
}

VarianceComponents components_of(const CubeSquares& ms, const Cube& cube) {
  const double np = static_cast<double>(cube.persons), nc = static_cast<double>(cube.cases),
               no = static_cast<double>(cube.occasions);
  return {.person = (ms.p - ms.pc - ms.po + ms.rest) / (nc * no),
          .cases = (ms.c - ms.pc - ms.co + ms.rest) / (np * no),
          .occasion = (ms.o - ms.po - ms.co + ms.rest) / (np * nc),
          .person_case = (ms.pc - ms.rest) / no,
          .person_occasion = (ms.po - ms.rest) / nc,
          .case_occasion = (ms.co - ms.rest) / np,
          .rest = ms.rest};
}

VarianceComponents components_of(const TwoWay& scores) {
  return {.person = (scores.ms_subjects - scores.ms_error) / scores.k,
          .cases = (scores.ms_raters - scores.ms_error) / scores.n,
          .rest = scores.ms_error};
}

VarianceComponents at_least_zero(VarianceComponents components) {
  for (double* one : {&components.person, &components.cases, &components.occasion, &components.person_case,
                      &components.person_occasion, &components.case_occasion})
    *one = std::max(0.0, *one);
  return components;
}

Interval phi_interval(const CubeSquares& ms, const Cube& cube) {
  const double np = static_cast<double>(cube.persons), nc = static_cast<double>(cube.cases),
               no = static_cast<double>(cube.occasions);
  const std::array<MeanSquare, 7> squares = {{{ms.p, np - 1.0},
                                              {ms.c, nc - 1.0},
                                              {ms.o, no - 1.0},
                                              {ms.pc, (np - 1.0) * (nc - 1.0)},
                                              {ms.po, (np - 1.0) * (no - 1.0)},
                                              {ms.co, (nc - 1.0) * (no - 1.0)},
                                              {ms.rest, (np - 1.0) * (nc - 1.0) * (no - 1.0)}}};
  return pivotal_interval(squares, kPivotalDraws, 1, [&](std::span<const double> e) {
    return phi(at_least_zero(components_of({e[0], e[1], e[2], e[3], e[4], e[5], e[6]}, cube)), nc, no);
  });
}

// What comes out negative, by name.
void note_negative(const VarianceComponents& raw, std::vector<std::string>& notes) {
  const std::pair<double, const char*> all[] = {
      {raw.person, "persons"},
      {raw.cases, "cases"},
      {raw.occasion, "occasions"},
      {raw.person_case, "persons by cases"},
      {raw.person_occasion, "persons by occasions"},
      {raw.case_occasion, "cases by occasions"},
  };
  for (const auto& [value, name] : all)
    if (value < 0.0)
      notes.push_back(std::string("The variance of ") + name + " came out negative and is set to 0.");
}

// One column for each case on each occasion; what it is stands in `which`.
struct Crossed {
  CompleteTable table;
  std::size_t cases = 0, occasions = 0;
  std::map<std::string, std::pair<std::size_t, std::size_t>> which;
};

Crossed crossed(const DataTable& table) {
  Crossed found;
  std::map<std::string, std::size_t> cases;
  std::map<double, std::size_t> occasions;
  DataTable flat = table;
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (table.rater[i].empty() || std::isnan(table.x[i])) {
      flat.rater[i].clear();
      continue;
    }
    const std::size_t c = cases.emplace(table.rater[i], cases.size()).first->second;
    const std::size_t o = occasions.emplace(table.x[i], occasions.size()).first->second;
    flat.rater[i] = std::to_string(c) + "/" + std::to_string(o);
    found.which[flat.rater[i]] = {c, o};
  }
  found.cases = cases.size();
  found.occasions = occasions.size();
  found.table = complete_table(flat);
  return found;
}

Cube cube_of(const Crossed& design) {
  Cube cube{design.table.rows, design.cases, design.occasions,
            std::vector<double>(design.table.rows * design.cases * design.occasions)};
  for (std::size_t p = 0; p < cube.persons; ++p)
    for (std::size_t j = 0; j < design.table.columns.size(); ++j) {
      const auto [c, o] = design.which.at(design.table.columns[j]);
      cube.values[(p * cube.cases + c) * cube.occasions + o] = design.table.at(p, j);
    }
  return cube;
}

double relative_error(const VarianceComponents& of, double cases, double occasions) {
  return of.person_case / cases + of.person_occasion / occasions + of.rest / (cases * occasions);
}

double absolute_error(const VarianceComponents& of, double cases, double occasions) {
  return relative_error(of, cases, occasions) + of.cases / cases + of.occasion / occasions +
         of.case_occasion / (cases * occasions);
}

void add_decision_rows(Answer& answer, const VarianceComponents& of, double cases, double occasions,
                       std::optional<double> needed) {
  std::set<double> numbers = {1, 2, 3, 4, 5, 6, 8, 10, 15, 20, cases};
  if (needed) numbers.insert(*needed);
  for (const double number : numbers)
    answer.rows.push_back({std::to_string(static_cast<long>(number)) + (number == 1.0 ? " case" : " cases"),
                           {{"cases", number},
                            {"occasions", occasions},
                            {"e_rho2", e_rho2(of, number, occasions)},
                            {"phi", phi(of, number, occasions)},
                            {"sem_absolute", std::sqrt(absolute_error(of, number, occasions))}}});
}

Answer answer_of(const VarianceComponents& raw, double cases, double occasions, double target, bool has_occasions) {
  Answer answer;
  answer.test = "g_theory";
  const VarianceComponents of = at_least_zero(raw);
  note_negative(raw, answer.notes);
  answer.method = has_occasions ? "Generalizability of persons by cases by occasions, all random, by analysis of "
                                  "variance; interval of Phi by pivotal quantities"
                                : "Generalizability of persons by cases, both random, by analysis of variance; "
                                  "interval of Phi by pivotal quantities";
  answer.estimate_name = "Phi of the mean over the cases given";
  answer.estimate = phi(of, cases, occasions);
  answer.more = {{"cases", cases}, {"var_person", of.person}, {"var_case", of.cases}};
  if (has_occasions)
    answer.more.insert(answer.more.end(), {{"occasions", occasions},
                                           {"var_occasion", of.occasion},
                                           {"var_person_case", of.person_case},
                                           {"var_person_occasion", of.person_occasion},
                                           {"var_case_occasion", of.case_occasion}});
  answer.more.insert(answer.more.end(), {{"var_residual", of.rest},
                                         {"e_rho2", e_rho2(of, cases, occasions)},
                                         {"phi_one_case", phi(of, 1.0, occasions)},
                                         {"phi_target", target}});
  const std::optional<double> for_phi = cases_for(of, target, occasions, false);
  const std::optional<double> for_ranking = cases_for(of, target, occasions, true);
  if (for_phi)
    answer.more.push_back({"cases_for_phi", *for_phi});
  else
    answer.notes.emplace_back("No number of cases brings Phi to its target: persons do not differ enough.");
  if (for_ranking) answer.more.push_back({"cases_for_e_rho2", *for_ranking});
  add_decision_rows(answer, of, cases, occasions, for_phi);
  return answer;
}

Answer three_way(const DataTable& table, double target) {
  const Crossed design = crossed(table);
  if (const char* reason = smaller_than(design.table, 2, 2)) return refused_table("g_theory", reason, design.table);
  if (design.cases < 2 || design.occasions < 2)
    return refused_table("g_theory", "too_few", design.table, "At least two cases and two occasions are needed.");
  if (design.table.columns.size() != design.cases * design.occasions)
    return refused_table("g_theory", "unbalanced", design.table, "Every case has to occur on every occasion.");
  const Cube cube = cube_of(design);
  const CubeSquares squares = mean_squares_of(cube);
  Answer answer = answer_of(components_of(squares, cube), static_cast<double>(cube.cases),
                            static_cast<double>(cube.occasions), target, true);
  answer.n = design.table.rows;
  answer.missing = design.table.missing;
  answer.ci95 = phi_interval(squares, cube);
  return answer;
}

Answer two_way_design(const DataTable& table, double target) {
  const CompleteTable full = complete_table(table);
  if (const char* reason = smaller_than(full, 2, 2)) return refused_table("g_theory", reason, full);
  const TwoWay scores = two_way(full);
  if (scores.sd == 0.0) return refused_table("g_theory", "no_variation", full);
  Answer answer = answer_of(components_of(scores), scores.k, 1.0, target, false);
  answer.n = full.rows;
  answer.missing = full.missing;
  answer.ci95 = pivotal_agreement_interval(scores, true);
  return answer;
}

}  // namespace

double e_rho2(const VarianceComponents& of, double cases, double occasions) {
  return of.person / (of.person + relative_error(of, cases, occasions));
}

double phi(const VarianceComponents& of, double cases, double occasions) {
  return of.person / (of.person + absolute_error(of, cases, occasions));
}

std::optional<double> cases_for(const VarianceComponents& of, double target, double occasions, bool relative) {
  const double may_err = of.person * (1.0 - target) / target;
  double fixed = of.person_occasion / occasions, by_case = of.person_case + of.rest / occasions;
  if (!relative) {
    fixed += of.occasion / occasions;
    by_case += of.cases + of.case_occasion / occasions;
  }
  if (!(may_err > fixed)) return std::nullopt;
  // A hair less, so that rounding does not ask for one case more than the target itself does.
  const double cases = std::max(1.0, std::ceil(by_case / (may_err - fixed) - 1e-9));
  if (!(cases <= kMostCases)) return std::nullopt;
  return cases;
}

Answer g_theory(const DataTable& table, double target) {
  Answer answer = table.x.empty() || table.rater.empty() ? two_way_design(table, target) : three_way(table, target);
  if (answer.missing > 0) answer.notes.emplace_back("Persons who lack a case are left out.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
