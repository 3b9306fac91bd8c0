// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/html.h"
#include "report/sections.h"
#include "report/viewer_data.h"

namespace wellknit {

namespace {

/// The controls stand in the page itself, so that it can be read what there is; report/assets/viewer.js gives them
/// life.
constexpr const char* controls = R"html(
<div class="controls">
<label>Colour <select id="v-array"></select></label>
<label>Look at <select id="v-target"></select></label>
<label>Cut <select id="v-axis">
<option value="none">none</option>
<option value="x">across x</option><option value="y">across y</option>
<option value="z">across depth</option><option value="well">along the well</option></select></label>
<label>at <input id="v-place" type="range" min="0" max="1000" value="500"></label>
<label><input id="v-flip" type="checkbox"> other side</label>
<label><input id="v-whole" type="checkbox"> whole cells</label>
<label>Shown <span class="pair"><input id="v-low" type="number" step="any" aria-label="at least"> to
<input id="v-high" type="number" step="any" aria-label="at most"></span></label>
<fieldset id="v-kinds"><legend>Kinds</legend></fieldset>
<label>Height × <input id="v-height" type="number" min="0.1" max="100" step="any"></label>
<label><input id="v-edges" type="checkbox" checked> edges</label>
<label><input id="v-wells" type="checkbox" checked> wells</label>
<label>Cell <input id="v-cell" type="number" min="0" step="1"></label>
<button type="button" id="v-top">from above</button>
<button type="button" id="v-side">from the side</button>
<button type="button" id="v-reset">reset</button>
</div>
<div class="stage">
<canvas id="v-canvas" tabindex="0" role="application" 
aria-label="The mesh in three dimensions. Arrow keys turn, with Shift move, plus and minus zoom,
square brackets move the cut."></canvas>
<div id="v-names" aria-hidden="true"></div>
<div id="v-legend" aria-hidden="true"></div>
<p id="v-state" role="status">The picture is being unpacked.</p>
</div>
<div id="v-numbers" aria-live="polite"></div>
)html";

}  // namespace

std::string view_section(const ReportInput& input) {
  if (!input.assessment.has_quality || input.mesh.cells.size() == 0) return "";
  const ViewerData data = viewer_data(input.mesh, input.view_budget);
  std::string out =
      "<section id=\"view\">\n<h2>The mesh</h2>\n<p class=\"hint\">Drag to turn, with the right button or "
      "Shift to move, wheel to zoom, click for a cell's numbers. Keys: arrows, Shift and arrows, + and −, "
      "[ and ] for the cut, Home.</p>\n";
  out += controls;
  if (!data.left_out.empty()) {
    out += "<p>Not in this file, for its size: ";
    for (std::size_t i = 0; i < data.left_out.size(); ++i) out += (i == 0 ? "" : ", ") + escaped(data.left_out[i]);
    out += ".</p>\n";
  }
  return out + data.html + "</section>\n";
}

}  // namespace wellknit
