# SPDX-License-Identifier: BSD-3-Clause
# How every target of this project is compiled, and the shape its libraries share.

add_library(cdca_options INTERFACE)
target_compile_options(cdca_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
  -Wcast-qual -Wcast-align -Wunused -Wformat=2 -Wextra-semi -Wredundant-decls
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond> $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op>
  # GCC 12 warns about its own std::string (bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(CDCA_WARNINGS_AS_ERRORS)
  # The last ones depend on how the optimizer inlines Eigen, and are often wrong: shown, but no errors.
  target_compile_options(cdca_options INTERFACE -Werror
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overflow> $<$<CXX_COMPILER_ID:GNU>:-Wno-error=stringop-overread>)
endif()
if(CDCA_NATIVE)
  target_compile_options(cdca_options INTERFACE -march=native)
endif()
if(CDCA_SANITIZE)
  set(CDCA_SANITIZE_FLAGS -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_options(cdca_options INTERFACE ${CDCA_SANITIZE_FLAGS})
  target_link_options(cdca_options INTERFACE ${CDCA_SANITIZE_FLAGS})
  add_library(cdca_keep_plugins OBJECT "${CMAKE_CURRENT_LIST_DIR}/keep_plugins.cpp")
endif()

# cdca_mpi_program(<name>): what a program that starts MPI needs besides its libraries.
function(cdca_mpi_program name)
  if(CDCA_SANITIZE)
    target_link_libraries(${name} PRIVATE cdca_keep_plugins)
  endif()
endfunction()

# cdca_precompile(<target> [<header>...]): headers of other projects that most of its files include are read once
# for all of them. Files still include what they use: builds without this must work.
function(cdca_precompile name)
  if(CDCA_PRECOMPILED_HEADERS)
    target_precompile_headers(${name} PRIVATE <algorithm> <cmath> <functional> <map> <optional> <span> <string> <vector>
      <Eigen/Dense> <Eigen/SparseCholesky> ${ARGN})
  endif()
endfunction()

# cdca_library(<name> [<linked targets>...]): a static library of every .cpp below the current folder.
# Includes are written from the top of the project: #include "core/mesh/grid.hpp".
function(cdca_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PRIVATE cdca_options)
    cdca_precompile(${name})
    set(scope PUBLIC)
  else()  # headers only
    add_library(${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${name} ${scope} "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/generated")
  target_compile_features(${name} ${scope} cxx_std_20)
  target_link_libraries(${name} ${scope} ${ARGN})
endfunction()
