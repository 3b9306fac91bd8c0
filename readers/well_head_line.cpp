// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/well_head_line.h"

#include <fmt/format.h>

#include <vector>

#include "model/errors.h"
#include "readers/station_table.h"
#include "readers/text.h"

namespace wellknit {

void take_head_line(std::string_view line, const std::string& path, std::int64_t number, WellHeads& heads) {
  line = trimmed(line);
  while (!line.empty() && (line.front() == '#' || line.front() == '-')) line.remove_prefix(1);
  std::string text(line);
  for (char& c : text)
    if (c == ',' || c == ';' || c == '=' || c == ':' || c == '\t') c = ' ';
  auto fields = split_fields(text, ' ');
  if (fields.empty() || !equal_ignoring_case(fields.front(), "head")) return;
  fields.erase(fields.begin());
  // "head X=1 Y=2 KB=3" says the same: the names of the columns are passed over.
  std::erase_if(fields, [](std::string_view field) { return station_column(field) != StationColumn::other; });
  double unit = 1.0;
  if (fields.size() > 3) {
    if (const auto found = si_of_unit(fields.back(), StationColumn::x)) {
      unit = *found;
      fields.pop_back();
    }
  }
  std::string name;
  if (fields.size() == 4) {
    name = std::string(unquoted(fields.front()));
    fields.erase(fields.begin());
  }
  std::vector<double> numbers;
  for (const std::string_view field : fields)
    if (const auto value = parse_real(field)) numbers.push_back(*value * unit);
  // Other sentences of a comment may begin with the word.
  if (numbers.empty()) return;
  if (fields.size() != 3 || numbers.size() != 3) {
    throw ParseError({path, number, "head"},
                     {"'# head X Y KB' with three numbers", fmt::format("{} of them", numbers.size()),
                      "give x and y of the head and the elevation of the datum"});
  }
  heads[name] = {numbers[0], numbers[1], numbers[2]};
}

WellHead head_for(const WellHeads& heads, const std::string& well) {
  if (const auto own = heads.find(well); own != heads.end()) return own->second;
  if (const auto all = heads.find(""); all != heads.end()) return all->second;
  return {};
}

}  // namespace wellknit
