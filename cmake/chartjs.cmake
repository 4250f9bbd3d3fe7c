# Chart.js (MIT), the plots of the page: one script, embedded at build time.
# SPDX-License-Identifier: GPL-3.0-or-later
# Headers: none
# Homes: pipeline/report
find_file(CHARTJS chart.min.js PATHS /usr/share/javascript/chart.js /usr/share/javascript REQUIRED DOC "Chart.js; Debian: libjs-chart.js")

# palpate_embed(<target> <name> <file>): the text of a file as `extern const std::string_view palpate::embedded::<name>`.
function(palpate_embed target name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/embedded_${name}.cpp)
  file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT
"// Generated: the text of a file.
#include <string_view>
namespace palpate::embedded {
extern const std::string_view @name@;
const std::string_view @name@ = R\"~embedded~(@text@)~embedded~\";
}  // namespace palpate::embedded
")
  target_sources(${target} PRIVATE ${generated})
endfunction()
