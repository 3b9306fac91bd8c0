# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DASSETS=a;b -DOUTPUT=file.cpp -P embed.cmake: text files as string literals, found by name with
# wellknit::report_asset() (report/assets.h). A literal has an upper length, so each line is one of its own.
set(text "// Made by cmake/embed.cmake.\n#include \"report/assets.h\"\n\nnamespace wellknit {\n\n")
string(APPEND text "std::string_view report_asset(std::string_view name) {\n")
foreach(asset ${ASSETS})
  get_filename_component(name ${asset} NAME)
  file(READ ${asset} content)
  string(REPLACE "\\" "\\\\" content "${content}")
  string(REPLACE "\"" "\\\"" content "${content}")
  string(REPLACE "\n" "\\n\"\n      \"" content "${content}")
  string(APPEND text "  if (name == \"${name}\") {\n    return\n      \"${content}\";\n  }\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace wellknit\n")
file(WRITE ${OUTPUT} "${text}")
