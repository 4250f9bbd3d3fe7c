# How a room, a program and a register are declared.
# SPDX-License-Identifier: GPL-3.0-or-later

add_library(palpate_flags INTERFACE)
target_compile_options(palpate_flags INTERFACE -Wall -Wextra -Wshadow -Wno-sign-compare
  -Wno-restrict)  # false positives of GCC 12 (PR105651)
target_include_directories(palpate_flags INTERFACE ${CMAKE_SOURCE_DIR}/include ${CMAKE_SOURCE_DIR})

# palpate_room(<name> [<library>...]): every .cpp of the current folder as the library palpate_<name>.
function(palpate_room name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_library(palpate_${name} STATIC ${sources})
  target_link_libraries(palpate_${name} PUBLIC palpate_words palpate_flags PRIVATE ${ARGN})
  set_property(GLOBAL APPEND PROPERTY PALPATE_ROOMS ${name})
endfunction()

# palpate_program(<file>.cpp [<library>...]): the executable palpate-<file>; palpate.cpp is palpate itself. A file that calls
# run_group is a group of commands with a main() of its own.
function(palpate_program file)
  cmake_path(GET file STEM stem)
  string(REPLACE "_" "-" program "palpate-${stem}")
  set(main palpate_main)
  if(stem STREQUAL "palpate")
    set(program palpate)
  endif()
  file(STRINGS ${file} is_group REGEX "run_group\\(")
  if(is_group)
    set(main "")
  endif()
  add_executable(${program} ${file})
  target_link_libraries(${program} PRIVATE ${main} palpate_words palpate_flags ${ARGN})
  set_property(GLOBAL APPEND PROPERTY PALPATE_PROGRAMS ${program})
endfunction()

# palpate_register(<target> <folder> <type> <header>): the folder is the register. Every <folder>/<name>.cpp defines
# `<type> <name>()` in namespace palpate::<folder>; all of them are compiled into the target, with a generated
# `std::vector<<type>> palpate::<folder>::all()`, which <header> declares.
function(palpate_register target folder type header)
  cmake_path(GET folder FILENAME space)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(declarations "")
  set(calls "")
  foreach(source ${sources})
    cmake_path(GET source STEM name)
    string(APPEND declarations "${type} ${name}();\n")
    string(APPEND calls "${name}(), ")
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/all_${space}.cpp)
  file(CONFIGURE OUTPUT ${generated} CONTENT
"// Generated from the files of ${space}/.
#include <${header}>

namespace palpate::${space} {
${declarations}
std::vector<${type}> all() { return {${calls}}; }
}  // namespace palpate::${space}
")
  target_sources(${target} PRIVATE ${sources} ${generated})
endfunction()
