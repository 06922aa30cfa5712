// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/reference_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace cdca::testing {

namespace {

constexpr const char* begin_mark = "<!-- results -->";
constexpr const char* end_mark = "<!-- end of results -->";
const std::vector<std::string> table_head{
    "| case | elements | compared | worst | computed | reference | error | allowed | within |",
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"};

std::string number(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string percent(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << 100 * value << " %";
  return text.str();
}

std::string row_of(const ReferenceResult& r) {
  std::ostringstream row;
  row << "| " << r.id << " | ";
  if (r.comparisons.empty()) {
    row << "| | " << r.note << " | | | | | |";
    return row.str();
  }
  const Comparison& w = r.worst();
  row << r.grid << " | " << r.comparisons.size() << " | " << w.quantity << ", " << w.place << " | "
      << number(w.computed, 5) << " | " << number(w.reference, 5) << " | " << percent(w.error)
      << " | " << percent(w.allowed) << " | " << (w.share() <= 1 ? "yes" : "**no**") << " |";
  return row.str();
}

/// "| id | ..." -> id
std::string id_of(const std::string& row) { return row.substr(2, row.find(" |", 2) - 2); }

struct Page {
  std::vector<std::string> before, rows, after;
};

Page read_page(const std::string& path) {
  Page page;
  std::ifstream file(path);
  std::vector<std::string>* part = &page.before;
  for (std::string line; std::getline(file, line);) {
    if (line == end_mark) part = &page.after;
    if (part == &page.rows) {
      const bool head = std::find(table_head.begin(), table_head.end(), line) != table_head.end();
      if (!head && line.rfind("| ", 0) == 0) part->push_back(line);
    } else {
      part->push_back(line);
    }
    if (line == begin_mark) part = &page.rows;
  }
  if (page.before.empty()) page.before = {"# Verification results", "", begin_mark};
  if (page.after.empty()) page.after = {end_mark};
  if (page.before.back() != begin_mark) {
    throw std::runtime_error(path + " has no line " + begin_mark + " with an end of results");
  }
  return page;
}

/// In the order of cases.json.
void sort_rows(std::vector<std::string>& rows) {
  const auto cases = reference_cases();
  const auto rank = [&cases](const std::string& row) {
    return std::find_if(cases.begin(), cases.end(),
                        [id = id_of(row)](const ReferenceCase& c) { return c.id == id; }) -
           cases.begin();
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

/// The tags of which the table has no case.
std::string missing_tags(const std::vector<std::string>& rows) {
  auto tags = reference_tags();
  tags.erase("information");  // asks for nothing
  for (const ReferenceCase& c : reference_cases()) {
    const auto is_mine = [&c](const std::string& row) { return id_of(row) == c.id; };
    if (std::any_of(rows.begin(), rows.end(), is_mine)) tags.erase(c.tag);
  }
  std::string list;
  for (const auto& [tag, count] : tags) {
    list += (list.empty() ? "" : ", ") + tag + " (" + std::to_string(count) + ")";
  }
  return list.empty() ? "All tags have results." : "Tags without results yet: " + list + ".";
}

/// How many cases are within their tolerance, and which are not.
std::vector<std::string> summary_of(const std::vector<std::string>& rows) {
  int inside = 0, elsewhere = 0;
  std::string outside;
  for (const std::string& row : rows) {
    if (row.find(" | yes |") != std::string::npos) {
      ++inside;
    } else if (row.find("**no**") != std::string::npos) {
      outside += (outside.empty() ? "" : ", ") + id_of(row);
    } else {
      ++elsewhere;
    }
  }
  std::ostringstream text;
  text << inside << " of " << int(rows.size()) - elsewhere << " cases are within their tolerance";
  if (elsewhere > 0) text << "; " << elsewhere << " more are tested elsewhere";
  text << ". Outside: " << (outside.empty() ? "none" : outside) << ".";
  return {"", text.str(), "", missing_tags(rows), ""};
}

double magnitude(const ExpectedTip& tip) { return std::hypot(tip.k1, tip.k2); }

/// What the errors of K_I and K_II of a tip are relative to, and how large they may be.
struct ErrorRule {
  std::array<double, 2> scale, allowed;
};

ErrorRule rule_for(const ExpectedTip& e, double largest, const ReferenceTolerance& t) {
  const auto or_largest = [&](double k) {
    return std::abs(k) > 1e-3 * largest ? std::abs(k) : largest;
  };
  if (t.k_rel_of_max) return {{largest, largest}, {*t.k_rel_of_max, *t.k_rel_of_max}};
  if (t.k2_rel) {
    return {{or_largest(magnitude(e)), or_largest(e.k2)},
            {t.k1_over_k2.value_or(*t.k2_rel), *t.k2_rel}};
  }
  if (t.k2_over_max || t.k_over_max) {
    return {{or_largest(e.k1), largest},
            {t.k_rel.value(), t.k2_over_max ? *t.k2_over_max : *t.k_over_max}};
  }
  const double size = or_largest(magnitude(e));
  return {{size, size}, {t.k_rel.value(), t.k_rel.value()}};
}

}  // namespace

const Comparison& ReferenceResult::worst() const {
  return *std::max_element(
      comparisons.begin(), comparisons.end(),
      [](const Comparison& a, const Comparison& b) { return a.share() < b.share(); });
}

std::vector<Comparison> compare_tips(const std::vector<ExpectedTip>& expected,
                                     const std::vector<ExpectedTip>& computed,
                                     const ReferenceTolerance& t, double unit) {
  double largest = 0.0;
  for (const ExpectedTip& tip : expected) largest = std::max(largest, magnitude(tip));
  if (largest < 1e-9 * unit) largest = unit;
  std::vector<Comparison> found;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const ExpectedTip& e = expected[k];
    const double k1 = computed[k].k1;
    const double k2 = e.sign_of_k2 ? computed[k].k2 : std::abs(computed[k].k2);
    const auto [scale, allowed] = rule_for(e, largest, t);
    const std::string place = "tip (" + number(e.at.x(), 4) + ", " + number(e.at.y(), 4) + ")";
    found.push_back({place, "K_I", k1, e.k1, std::abs(k1 - e.k1) / scale[0], allowed[0]});
    found.push_back({place, "K_II", k2, e.k2, std::abs(k2 - e.k2) / scale[1], allowed[1]});
  }
  return found;
}

std::string log_of(const ReferenceResult& result) {
  std::ostringstream text;
  for (const Comparison& c : result.comparisons) {
    text << result.id << ": " << c.place << " " << c.quantity << " " << number(c.computed, 6)
         << " / " << number(c.reference, 6) << ", error " << percent(c.error) << " of "
         << percent(c.allowed) << (c.share() <= 1 ? "" : "  <-- outside") << "\n";
  }
  if (result.comparisons.empty()) text << result.id << ": " << result.note << "\n";
  return text.str();
}

void write_row(const ReferenceResult& result) {
  const char* path = std::getenv("CDCA_VERIFICATION_TABLE");
  if (!path || !*path) return;
  Page page = read_page(path);
  page.rows.erase(std::remove_if(page.rows.begin(), page.rows.end(),
                                 [&](const std::string& row) { return id_of(row) == result.id; }),
                  page.rows.end());
  page.rows.push_back(row_of(result));
  sort_rows(page.rows);
  const std::string draft = std::string(path) + ".new";
  {
    std::ofstream file(draft);
    const auto write = [&file](const std::vector<std::string>& lines) {
      for (const std::string& line : lines) file << line << "\n";
    };
    write(page.before);
    write(summary_of(page.rows));
    write(table_head);
    write(page.rows);
    file << "\n";
    write(page.after);
    if (!file) throw std::runtime_error(std::string("cannot write ") + draft);
  }
  std::filesystem::rename(draft, path);
}

}  // namespace cdca::testing
