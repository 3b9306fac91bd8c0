// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The operations of a deck on its arrays: on boxes (EQUALS, COPY, OPERATE …) and on regions (EQUALREG, COPYREG,
/// OPERATER …). Values are in the deck's units all the while, so that a number of the deck needs no conversion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "readers/cell_arrays.h"
#include "readers/text.h"
#include "readers/unapplied.h"

namespace wellknit {

/// The cells that a record concerns: those of a box, or of one region.
struct CellArrays::Selection {
  CellBox box;
  const std::vector<std::int32_t>* regions = nullptr;  ///< nx ny nz; nothing: the whole box
  std::int32_t region = 0;
  bool has_unset = false;  ///< cells without a number belong to the region

  template <class Visit>
  void for_each(const std::array<std::int64_t, 3>& dimensions, Visit visit) const {
    for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k) {
      for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j) {
        const std::int64_t row = dimensions[0] * (j + dimensions[1] * k);
        for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i) {
          const auto cell = static_cast<std::size_t>(row + i);
          if (regions == nullptr || is_in(cell)) visit(cell);
        }
      }
    }
  }
  [[nodiscard]] bool is_in(std::size_t cell) const {
    return is_given((*regions)[cell]) ? (*regions)[cell] == region : has_unset;
  }
};

/// An array to write to, and what its unset values count as.
struct CellArrays::Target {
  CellArray* array = nullptr;
  const CellArrayRule* rule = nullptr;

  [[nodiscard]] double fallback() const { return rule->has_default ? rule->default_value : unset_real; }
  /// In double; NaN where nothing is given and there is no default.
  [[nodiscard]] double at(std::size_t cell) const {
    return std::visit(
        [&](const auto& values) { return is_given(values[cell]) ? static_cast<double>(values[cell]) : fallback(); },
        array->values);
  }
  /// Integers are held within the range of 32 bits, so that no operation overflows.
  void set(std::size_t cell, double value) const {
    if (auto* reals = std::get_if<std::vector<double>>(&array->values))
      (*reals)[cell] = value;
    else
      std::get<std::vector<std::int32_t>>(array->values)[cell] =
          std::isnan(value) ? unset_integer
                            : static_cast<std::int32_t>(std::clamp(std::trunc(value), -2147483647.0, 2147483647.0));
  }
  [[nodiscard]] bool is_integer() const { return array->values.index() == 1; }
};

/// A function of OPERATE: of the old value r, the source's value x, and two numbers.
struct CellArrays::Function {
  using Evaluate = double (*)(double r, double x, double a, double b);
  std::string_view name;
  Evaluate evaluate;
};

namespace {

constexpr std::array by_region{"EQUALREG", "ADDREG", "MULTIREG", "COPYREG", "OPERATER"};

ArrayOperation operation_of(const std::string& keyword) {
  if (keyword == "EQUALS" || keyword == "EQUALREG") return ArrayOperation::set;
  if (keyword == "ADD" || keyword == "ADDREG") return ArrayOperation::add;
  if (keyword == "MULTIPLY" || keyword == "MULTIREG") return ArrayOperation::multiply;
  if (keyword == "MINVALUE") return ArrayOperation::at_least;
  if (keyword == "MAXVALUE") return ArrayOperation::at_most;
  return ArrayOperation::copy;
}

/// An unset old value stays unset.
double operated(ArrayOperation operation, double old, double value) {
  switch (operation) {
    case ArrayOperation::set: return value;
    case ArrayOperation::add: return old + value;
    case ArrayOperation::multiply: return old * value;
    case ArrayOperation::at_least: return std::max(old, value);
    case ArrayOperation::at_most: return std::min(old, value);
    case ArrayOperation::copy: break;
  }
  return old;
}

std::optional<RegionSet> region_set_of(const std::string& word) {
  if (word == "M" || word == "MULTNUM") return RegionSet::multnum;
  if (word == "F" || word == "FLUXNUM") return RegionSet::fluxnum;
  if (word == "O" || word == "OPERNUM") return RegionSet::opernum;
  return std::nullopt;
}

}  // namespace

void CellArrays::read_operation() {
  require_dimensions();
  const std::string& keyword = stream_.keyword().name;
  const bool is_by_region = std::find(by_region.begin(), by_region.end(), keyword) != by_region.end();
  const bool is_operate = keyword == "OPERATE" || keyword == "OPERATER";
  const std::size_t most_items = keyword == "OPERATE" ? 11 : keyword == "OPERATER" ? 7 : is_by_region ? 4 : 8;
  Selection selection;
  selection.box = box_;
  while (true) {
    const DeckRecord record = stream_.next_record(most_items);
    if (record.empty()) return;
    if (!record.has(0) || (!record.has(1) && keyword != "OPERATE"))
      stream_.fail(record.line,
                   {"the name of an array and a second item", "less", "see the keyword's records in the manual"});
    if (is_by_region) {
      selection = read_region(record, is_operate ? 1 : 2, is_operate ? "OPERNUM" : default_region_set());
    } else {
      // Box items left out stay as the record before them had them.
      const std::size_t first_item = is_operate ? 1 : 2;
      selection.box = read_box_items(record, first_item, selection.box);
      note_partial_box(record, first_item, selection.box);
    }
    stream_.charge_steps(selection.box.cell_count());
    apply(record, selection);
  }
}

void CellArrays::apply(const DeckRecord& record, const Selection& selection) {
  const std::string& keyword = stream_.keyword().name;
  const std::string name = *stream_.word(record, 0);
  if (keyword == "OPERATE") return operate(record, 7, selection);
  if (keyword == "OPERATER") return operate(record, 2, selection);
  if (keyword == "COPY" || keyword == "COPYREG") return copy(name, record, selection);
  change(name, record, selection);
}

/// Simulators differ where a record gives some items of its box and leaves others out.
void CellArrays::note_partial_box(const DeckRecord& record, std::size_t first_item, const CellBox& box) {
  std::size_t given = 0;
  bool narrower = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool first = record.has(first_item + 2 * axis);
    const bool last = record.has(first_item + 2 * axis + 1);
    given += (first ? 1U : 0U) + (last ? 1U : 0U);
    narrower = narrower || (!first && box.first[axis] != 0) || (!last && box.last[axis] != dimensions_[axis] - 1);
  }
  if (given > 0 && narrower)
    stream_.note_once("partial box", record.line,
                      fmt::format("{}: the limits left out are those of the record or BOX before; OPM Flow takes the "
                                  "whole grid along them",
                                  stream_.keyword().name));
}

/// MULTNUM where GRIDOPTS provides for multiplier regions, else FLUXNUM: as simulators do in practice.
std::string CellArrays::default_region_set() const { return multiplier_regions_ > 0 ? "MULTNUM" : "FLUXNUM"; }

CellArrays::Selection CellArrays::read_region(const DeckRecord& record, std::size_t item,
                                              const std::string& default_set) {
  const std::size_t set_item = stream_.keyword().name == "OPERATER" ? 6 : 3;
  std::string name = default_set;
  if (const auto word = stream_.word(record, set_item)) {
    const auto set = region_set_of(*word);
    const CellArrayRule* rule = find_cell_array(*word);
    if (!set && (rule == nullptr || rule->kind != CellArrayKind::integer))
      stream_.fail(record.line, {fmt::format("F, M or O as item {}", set_item + 1), quoted_for_message(*word),
                                 "it names the regions: FLUXNUM, MULTNUM or OPERNUM"});
    name = set ? keyword_of(*set) : *word;
  }
  const auto region = stream_.integer(record, item);
  if (!region || std::abs(static_cast<double>(*region)) > 2147483647.0)
    stream_.fail(record.line, {fmt::format("the number of a region as item {}", item + 1),
                               region ? quoted_for_message(record.items[item].text) : "none", ""});
  const auto found = arrays.find(name);
  if (found == arrays.end())
    stream_.fail(record.line, {fmt::format("the regions {} before it", name), "none",
                               "give that array first, or name the regions with F, M or O"});
  Selection selection;
  selection.box.last = {dimensions_[0] - 1, dimensions_[1] - 1, dimensions_[2] - 1};
  selection.regions = &std::get<std::vector<std::int32_t>>(found->second.values);
  selection.region = static_cast<std::int32_t>(*region);
  selection.has_unset = find_cell_array(name)->default_value == static_cast<double>(*region);
  bool is_empty = true;
  for (std::size_t cell = 0; is_empty && cell < selection.regions->size(); ++cell) is_empty = !selection.is_in(cell);
  if (is_empty)
    stream_.note(record.line, fmt::format("{}: no cell is in region {} of {}", stream_.keyword().name, *region, name));
  return selection;
}

void CellArrays::require_source(const std::string& name, std::int64_t line) const {
  const CellArrayRule* rule = find_cell_array(name);
  if (rule != nullptr && !rule->has_default && arrays.find(stored_name(name)) == arrays.end())
    stream_.fail(line, {fmt::format("the array {} before it", name), "none", "give the array first"});
}

/// The array to write to, with its place noted; no array for a name that is not carried.
CellArrays::Target CellArrays::target_of(const std::string& name, std::int64_t line) {
  Target target{find_or_make(name, line), find_cell_array(name)};
  if (target.array == nullptr) return target;
  target.array->last_set = here();
  target.array->last_set.line = line;
  if (ends_in_edits(name)) note_not_applied(stream_, name, line);
  return target;
}

void CellArrays::note_unknown(const std::string& name, std::int64_t line) {
  if (is_unapplied_array(name))
    note_not_applied(stream_, name, line);
  else
    stream_.note_once(name, line,
                      fmt::format("{} on {}: no array of this name is carried; skipped", stream_.keyword().name,
                                  quoted_for_message(name)));
}

void CellArrays::change(const std::string& name, const DeckRecord& record, const Selection& selection) {
  if (const auto computed = find_computed_array(name)) return edit_computed(*computed, record, selection);
  const ArrayOperation operation = operation_of(stream_.keyword().name);
  const double value = *stream_.real(record, 1);
  if (operation != ArrayOperation::set) require_source(name, record.line);
  const Target target = target_of(name, record.line);
  if (target.array == nullptr) return;
  if (target.is_integer() && operation != ArrayOperation::multiply && value != std::trunc(value))
    stream_.fail(record.line, {fmt::format("an integer for {}", name), quoted_for_message(record.items[1].text), ""});
  if (auto* reals = std::get_if<std::vector<double>>(&target.array->values)) {
    const double fallback = target.fallback();
    return selection.for_each(dimensions_, [&](std::size_t cell) {
      double& entry = (*reals)[cell];
      entry = operated(operation, is_given(entry) ? entry : fallback, value);
    });
  }
  selection.for_each(dimensions_,
                     [&](std::size_t cell) { target.set(cell, operated(operation, target.at(cell), value)); });
}

void CellArrays::copy(const std::string& from, const DeckRecord& record, const Selection& selection) {
  const std::string to = *stream_.word(record, 1);
  const auto computed = find_computed_array(to);
  if (computed && find_computed_array(from)) return edit_computed(*computed, record, selection);
  if (computed || find_computed_array(from)) {
    const std::string text = fmt::format("{} of {} to {}: one is computed by the simulator, the other is not; skipped",
                                         stream_.keyword().name, quoted_for_message(from), quoted_for_message(to));
    return stream_.note_once(from + " to " + to, record.line, text);
  }
  if (find_cell_array(from) == nullptr) return note_unknown(from, record.line);
  require_source(from, record.line);
  const Target target = target_of(to, record.line);
  if (target.array == nullptr) return;
  const CellArray* source = find_or_make(from, record.line);
  if (source->values.index() != target.array->values.index())
    stream_.fail(record.line, {"two arrays of one kind", fmt::format("{} and {}", from, to),
                               "one is of integers, the other is not"});
  std::visit(
      [&](auto& values) {
        const auto& given = std::get<std::decay_t<decltype(values)>>(source->values);
        selection.for_each(dimensions_, [&](std::size_t cell) { values[cell] = given[cell]; });
      },
      target.array->values);
}

void CellArrays::operate(const DeckRecord& record, std::size_t function_item, const Selection& selection) {
  static constexpr std::array functions{
      Function{"MULTA", [](double, double x, double a, double b) { return a * x + b; }},
      Function{"MULTX", [](double, double x, double a, double) { return a * x; }},
      Function{"ADDX", [](double, double x, double a, double) { return a + x; }},
      Function{"MULTIPLY", [](double r, double x, double, double) { return r * x; }},
      Function{"POLY", [](double r, double x, double a, double b) { return r + a * std::pow(x, b); }},
      Function{"MULTP", [](double, double x, double a, double b) { return a * std::pow(x, b); }},
      Function{"SLOG", [](double, double x, double a, double b) { return std::pow(10.0, a + b * x); }},
      Function{"LOG10", [](double, double x, double, double) { return std::log10(x); }},
      Function{"LOGE", [](double, double x, double, double) { return std::log(x); }},
      Function{"INV", [](double, double x, double, double) { return 1.0 / x; }},
      Function{"ABS", [](double, double x, double, double) { return std::abs(x); }},
      Function{"COPY", [](double, double x, double, double) { return x; }},
      Function{"MAXLIM", [](double, double x, double a, double) { return std::min(x, a); }},
      Function{"MINLIM", [](double, double x, double a, double) { return std::max(x, a); }}};
  const std::string to = *stream_.word(record, 0);
  const std::string name = stream_.word(record, function_item).value_or("");
  const std::string from = stream_.word(record, function_item + 1).value_or(to);
  const double a = stream_.real(record, function_item + 2).value_or(0.0);
  const double b = stream_.real(record, function_item + 3).value_or(0.0);
  const auto* const function =
      std::find_if(functions.begin(), functions.end(), [&](const Function& f) { return f.name == name; });
  if (function == functions.end())
    stream_.fail(record.line,
                 {fmt::format("a function as item {}", function_item + 1), quoted_for_message(name),
                  "MULTA, MULTX, ADDX, MULTIPLY, POLY, MULTP, SLOG, LOG10, LOGE, INV, ABS, COPY, MAXLIM or MINLIM"});
  if (find_computed_array(to) || find_computed_array(from)) {
    const std::string text = fmt::format("{} on {} from {}: an array that the simulator computes; skipped",
                                         stream_.keyword().name, quoted_for_message(to), quoted_for_message(from));
    return stream_.note_once(stream_.keyword().name + to + from, record.line, text);
  }
  if (find_cell_array(from) == nullptr) return note_unknown(from, record.line);
  require_source(from, record.line);
  if (name == "MULTIPLY" || name == "POLY") require_source(to, record.line);
  const Target target = target_of(to, record.line);
  if (target.array == nullptr) return;
  const Target source{find_or_make(from, record.line), find_cell_array(from)};
  selection.for_each(dimensions_, [&](std::size_t cell) {
    const double x = source.at(cell);
    const double r = target.at(cell);
    const double result = function->evaluate(r, x, a, b);
    const bool needs_old = name == "MULTIPLY" || name == "POLY";
    if (!std::isfinite(result) && std::isfinite(x) && (!needs_old || std::isfinite(r)))
      stream_.fail(record.line, {fmt::format("a finite result of {}", name), fmt::format("{} from {}", result, x),
                                 "the function is not defined there"});
    target.set(cell, is_given(x) ? result : unset_real);
  });
}

void CellArrays::edit_computed(ComputedArray array, const DeckRecord& record, const Selection& selection) {
  const std::string& keyword = stream_.keyword().name;
  if (selection.regions != nullptr) {
    const std::string name = keyword_of(array);
    return stream_.note_once(keyword + name, record.line,
                             fmt::format("{} on {}: an array that the simulator computes; skipped", keyword, name));
  }
  ArrayEdit edit;
  edit.array = array;
  edit.operation = operation_of(keyword);
  edit.cells = selection.box;
  if (edit.operation == ArrayOperation::copy) {
    edit.source = *find_computed_array(*stream_.word(record, 0));
    edit.array = *find_computed_array(*stream_.word(record, 1));
  } else {
    edit.value = *stream_.real(record, 1);
  }
  stream_.charge_values(static_cast<std::int64_t>(sizeof(ArrayEdit) / sizeof(double)));
  note_not_applied(stream_, keyword_of(edit.array), record.line);
  edits.push_back(std::move(edit));
}

}  // namespace wellknit
