// HTML by hand: few pieces, each escaped where it enters.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/html.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace palpate {
namespace {

/// The largest of 1, 2, 5 × 10^n that is at most `length`.
double round_length(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (double step : {5.0, 2.0})
    if (step * power <= length) return step * power;
  return power;
}

/// The patient's direction nearest to a unit vector: L(eft), R(ight), A(nterior), P(osterior), S(uperior), I(nferior); two
/// letters in between.
std::string patient_direction(const Vec3& direction) {
  static const char* letters[3][2] = {{"R", "L"}, {"A", "P"}, {"I", "S"}};
  std::vector<std::pair<double, std::string>> parts;
  for (int a = 0; a < 3; ++a)
    if (std::abs(direction[a]) > 0.38) parts.emplace_back(-std::abs(direction[a]), letters[a][direction[a] > 0]);
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first - 1e-6; });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, parts.size()); ++i) text += parts[i].second;
  return text;
}

std::string svg_text(double x, double y, const char* anchor, const std::string& text) {
  char place[96];
  std::snprintf(place, sizeof place, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"%s\">", x, y, anchor);
  return place + text + "</text>";
}

/// Scale bar at the lower left, letters at the four sides.
std::string overlay(const Picture& picture) {
  const double w = picture.width, h = picture.height;
  const double length_mm = round_length(0.22 * w * picture.mm_per_pixel), length = length_mm / picture.mm_per_pixel;
  char head[320];
  std::snprintf(head, sizeof head, "<svg viewBox=\"0 0 %.0f %.0f\" aria-hidden=\"true\"><path d=\"M14 %.1f v8 h%.1f v-8\"/>", w,
                h, h - 18, length);
  return head + svg_text(22 + length, h - 8, "start", readable(length_mm) + " mm") +
         svg_text(w - 8, h / 2 + 7, "end", patient_direction(picture.right)) +
         svg_text(8, h / 2 + 7, "start", patient_direction(-1.0 * picture.right)) +
         svg_text(w / 2, 20, "middle", patient_direction(picture.up)) +
         svg_text(w / 2, h - 6, "middle", patient_direction(-1.0 * picture.up)) + "</svg>";
}

bool is_number_list(const Json& json) {
  return json.is_array() && !json.empty() && std::all_of(json.begin(), json.end(), [](const Json& x) { return x.is_number(); });
}

std::string scalar_html(const Json& json) {
  if (json.is_number_integer()) return readable(json.get<double>(), 15);
  if (json.is_number()) return readable(json.get<double>());
  if (json.is_boolean()) return json.get<bool>() ? "yes" : "no";
  if (json.is_null()) return "–";
  return escaped(json.is_string() ? json.get<std::string>() : json.dump());
}

std::string number_list_html(const Json& json) {
  constexpr std::size_t shown = 8;
  if (json.size() > shown) {
    const auto [low, high] = std::minmax_element(json.begin(), json.end(),
                                                 [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); });
    return std::to_string(json.size()) + " numbers, " + scalar_html(*low) + " … " + scalar_html(*high);
  }
  std::string text;
  for (const Json& x : json) text += (text.empty() ? "" : ", ") + scalar_html(x);
  return text;
}

/// "volume_mm3" → "volume (mm³)": a key's words, its unit in brackets.
std::string spaced(std::string key) {
  static const std::vector<std::pair<std::string, std::string>> units{{"mm", "mm"}, {"mm2", "mm²"}, {"mm3", "mm³"}, {"deg", "°"},
                                                                      {"N", "N"},   {"MPa", "MPa"}, {"s", "s"}};
  std::string unit;
  for (const auto& [suffix, text] : units) {
    if (key == suffix) return text;
    if (key.ends_with("_" + suffix)) unit = " (" + text + ")";
  }
  if (!unit.empty()) key.erase(key.rfind('_'));
  std::replace(key.begin(), key.end(), '_', ' ');
  return escaped(key) + unit;
}

/// A list of objects with the same keys, as rows under a header.
std::string record_table(const Json& records) {
  std::string html = "<table><thead><tr>";
  for (const auto& [key, value] : records.front().items())
    html += std::string("<th scope=\"col\"") + (value.is_number() ? " class=\"n\">" : ">") + spaced(key) + "</th>";
  html += "</tr></thead><tbody>";
  for (const Json& record : records) {
    html += "<tr>";
    for (const auto& [key, value] : record.items())
      html += std::string(value.is_number() ? "<td class=\"n\">" : "<td>") + json_table(value) + "</td>";
    html += "</tr>";
  }
  return html + "</tbody></table>";
}

bool same_keys(const Json& a, const Json& b) {
  if (!a.is_object() || !b.is_object() || a.size() != b.size() || a.empty()) return false;
  return std::equal(a.items().begin(), a.items().end(), b.items().begin(),
                    [](const auto& x, const auto& y) { return x.key() == y.key(); });
}

/// An object of objects with the same keys {"cortex": {…}, "pelvis": {…}}: the outer key becomes the first column.
bool is_keyed_table(const Json& json) {
  return json.is_object() && json.size() > 1 &&
         std::all_of(json.begin(), json.end(), [&](const Json& value) { return same_keys(value, *json.begin()); });
}

std::string keyed_table(const Json& json) {
  std::string html = "<table><thead><tr><th scope=\"col\"></th>";
  for (const auto& [key, value] : json.begin()->items())
    html += std::string("<th scope=\"col\"") + (value.is_number() ? " class=\"n\">" : ">") + spaced(key) + "</th>";
  html += "</tr></thead><tbody>";
  for (const auto& [name, record] : json.items()) {
    html += "<tr><th scope=\"row\">" + spaced(name) + "</th>";
    for (const auto& [key, value] : record.items())
      html += std::string(value.is_number() ? "<td class=\"n\">" : "<td>") + json_table(value) + "</td>";
    html += "</tr>";
  }
  return html + "</tbody></table>";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (char c : text) switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      case '\'': safe += "&#39;"; break;
      default: safe += c;
    }
  return safe;
}

std::string readable(double x, int digits) {
  if (!std::isfinite(x)) return "–";
  char text[64];
  const bool long_number = std::abs(x) >= 1e4 && std::abs(x) < 1e15;
  if (long_number)
    std::snprintf(text, sizeof text, "%.0f", x);
  else
    std::snprintf(text, sizeof text, "%.*g", digits, x);
  std::string number = text;
  const std::size_t first = number.find_first_not_of('-');
  for (std::size_t at = number.size(); long_number && at > first + 3;) number.insert(at -= 3, "\u202f");
  return number;
}

std::string script_json(const Json& json) {
  std::string text = json.dump();
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.replace(at, 2, "<\\/");
  return text;
}

std::string base64(const std::string& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string table_row(const std::vector<std::string>& cells, const std::string& cell_tag, std::size_t numeric_from) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool row_head = i == 0 && cell_tag == "td";
    const std::string tag = row_head ? "th" : cell_tag;
    html += "<" + tag +
            (row_head           ? " scope=\"row\""
             : cell_tag == "th" ? " scope=\"col\""
                                : "") +
            (i >= numeric_from ? " class=\"n\"" : "") + ">" + cells[i] + "</" + tag + ">";
  }
  return html + "</tr>";
}

std::string json_table(const Json& json) {
  if (is_number_list(json)) return number_list_html(json);
  if (json.is_array()) {
    if (json.empty()) return "none";
    if (std::all_of(json.begin(), json.end(), [&](const Json& x) { return same_keys(x, json.front()); }))
      return record_table(json);
    std::string html;
    for (const Json& x : json) html += (html.empty() ? "" : "<br>") + json_table(x);
    return html;
  }
  if (!json.is_object()) return scalar_html(json);
  if (is_keyed_table(json)) return keyed_table(json);
  std::string html = "<table><tbody>";
  for (const auto& [key, value] : json.items())
    html += "<tr><th scope=\"row\">" + spaced(key) + "</th><td" + (value.is_number() ? " class=\"n\"" : "") + ">" +
            json_table(value) + "</td></tr>";
  return html + "</tbody></table>";
}

std::string facts_html(const Json& facts) {
  Json plain = Json::object();
  std::string groups;
  for (const auto& [key, value] : facts.items()) {
    if (value.is_structured() && !value.empty() && !is_number_list(value))
      groups += "<div><h4>" + spaced(key) + "</h4>" + json_table(value) + "</div>\n";
    else
      plain[key] = value;
  }
  return "<div class=\"facts\">\n" + (plain.empty() ? "" : "<div>" + json_table(plain) + "</div>\n") + groups + "</div>\n";
}

std::string picture_figure(const Picture& picture, const std::string& alt, const std::string& caption) {
  const std::string size = "width=\"" + std::to_string(picture.width) + "\" height=\"" + std::to_string(picture.height) + "\"";
  return "<figure><div class=\"picture\"><img " + size + " alt=\"" + escaped(alt) + "\" src=\"data:image/png;base64," +
         base64(picture.png) + "\">" + overlay(picture) + "</div><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string colour_bar(const std::string& field, Tones tones, const std::string& top) {
  std::string stops;
  for (const auto& colour : tone_colours(tones)) stops += ", " + colour;
  return "<div class=\"bar\" role=\"img\" aria-label=\"" + escaped(field + ", colours from 0 to " + top) + "\"><span>" +
         escaped(field) + " 0</span><i style=\"background: linear-gradient(to right" + stops + ")\"></i><span>" + escaped(top) +
         "</span></div>\n";
}

std::string plot_figure(const std::string& id, const Json& plot, const std::string& alt, const std::string& css_class) {
  return "<div class=\"" + css_class + "\"><canvas data-plot=\"" + id + "\" role=\"img\" aria-label=\"" + escaped(alt) +
         "\"></canvas></div>\n" + "<script type=\"application/json\" id=\"" + id + "\">" + script_json(plot) + "</script>\n";
}

}  // namespace palpate
