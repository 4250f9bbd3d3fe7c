// One file that needs no other: style and scripts are inside.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pipeline/report/shell.hpp>

#include <string_view>

#include <pipeline/report/html.hpp>

namespace palpate {

namespace embedded {  // texts of files, generated at build time
extern const std::string_view chart_js, page_css, page_js;
}  // namespace embedded

namespace {

/// Lets nothing in from outside: the page shows the same with and without a network.
const char* const policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// Collects what goes wrong before page.js runs.
const char* const error_catcher =
    "window.pageErrors = [];\n"
    "addEventListener(\"error\", e => window.pageErrors.push(String(e.message || (e.target && e.target.tagName + \" does not "
    "load\"))), true);\n"
    "addEventListener(\"unhandledrejection\", e => window.pageErrors.push(String(e.reason)));\n"
    "addEventListener(\"securitypolicyviolation\", e => window.pageErrors.push(\"blocked: \" + e.blockedURI));\n";

}  // namespace

std::string section(const std::string& id, const std::string& title, const std::string& body) {
  return body.empty() ? ""
                      : "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-title\">\n<h2 id=\"" + id + "-title\">" + title +
                            "</h2>\n" + body + "</section>\n";
}

std::string wide(const std::string& table) { return "<div class=\"wide\">" + table + "</div>\n"; }

std::string whole_page(const std::string& title, const std::string& header, const std::string& body, const std::string& versions) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"";
  html += policy;
  html += "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" + escaped(title) +
          "</title>\n<style>\n";
  html += embedded::page_css;
  html += "</style>\n<script>\n";
  html += error_catcher;
  html += "</script>\n</head>\n<body>\n" + header + "<main>\n" + body;
  html += "</main>\n<footer><p>Units: mm, tonne, second, so N and MPa; space: patient LPS. Palpate " + escaped(versions) +
          ". Plots: Chart.js (MIT). Pictures: VTK. This file needs no other and no network.</p></footer>\n<script>\n";
  html += embedded::chart_js;
  html += "\n</script>\n<script>\n";
  html += embedded::page_js;
  return html + "</script>\n</body>\n</html>\n";
}

}  // namespace palpate
