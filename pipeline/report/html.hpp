// Pieces of HTML: text made safe, numbers a person can read, tables, pictures inside the page.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include <palpate/json.hpp>
#include <pipeline/report/picture.hpp>

namespace palpate {

/// & < > " ' replaced, for text and attribute values.
std::string escaped(const std::string& text);

/// `digits` significant digits, no trailing zeros, thin spaces between thousands: 12 345, 0.0312, 1.2e-7.
std::string readable(double x, int digits = 4);

/// JSON for a <script type="application/json">: no "</" can end the element.
std::string script_json(const Json& json);

std::string base64(const std::string& bytes);

/// Any JSON as nested tables; keys lose their underscores. Long lists of numbers are shown as their count and range.
std::string json_table(const Json& json);

/// An object's plain values in one table, each of its parts in one of its own, side by side where there is room.
std::string facts_html(const Json& facts);

/// One row of cells; `numeric_from`: cells from that index on are numbers, right-aligned.
std::string table_row(const std::vector<std::string>& cells, const std::string& cell_tag, std::size_t numeric_from);

/// A picture with a scale bar and the patient's directions, `alt` for those who do not see it, `caption` as HTML.
std::string picture_figure(const Picture& picture, const std::string& alt, const std::string& caption);

/// The bar of a field's colours from 0 to `top`, which is text with a unit.
std::string colour_bar(const std::string& field, Tones tones, const std::string& top);

/// A canvas that page.js fills from `plot`.
std::string plot_figure(const std::string& id, const Json& plot, const std::string& alt, const std::string& css_class);

}  // namespace palpate
