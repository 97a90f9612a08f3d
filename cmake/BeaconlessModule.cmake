# SPDX-License-Identifier: Apache-2.0
# One library per folder of beaconless/, so that the linker knows the layers too.

# What every target of this project is compiled with; never exported to users.
add_library(beaconless_build_flags INTERFACE)
# GCC 12 sees overlapping copies in std::string + const char* (its PR 105651): -Wno-restrict. Designated
# initialisers leave fields at their defaults on purpose: -Wno-missing-field-initializers.
target_compile_options(beaconless_build_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Werror=return-type -Wno-missing-field-initializers
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                       $<$<BOOL:${BEACONLESS_PARANOID}>:-Werror>)
if(BEACONLESS_SANITIZE)
  # With sanitizers GCC 12 takes a moved std::variant for an uninitialised one: -Wno-maybe-uninitialized.
  target_compile_options(beaconless_build_flags INTERFACE -fsanitize=${BEACONLESS_SANITIZE} -Wno-maybe-uninitialized
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(beaconless_build_flags INTERFACE -fsanitize=${BEACONLESS_SANITIZE})
endif()
if(BEACONLESS_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "BEACONLESS_FUZZ needs clang, not ${CMAKE_CXX_COMPILER_ID}: its libFuzzer drives the fuzz targets. "
                        "Configure a fresh folder by `cmake --preset fuzz`, or with -DCMAKE_CXX_COMPILER=clang++-14")
  endif()
  target_compile_options(beaconless_build_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
endif()

# beaconless_precompile(target headers…): what every source of the target would parse again is parsed once. The first
# target of a kind names the headers; those that are compiled alike reuse them: beaconless_precompile(target FROM first).
function(beaconless_precompile target)
  cmake_parse_arguments(arg "" "FROM" "" ${ARGN})
  if(NOT BEACONLESS_PRECOMPILE)
    return()
  endif()
  if(arg_FROM)
    target_precompile_headers(${target} REUSE_FROM ${arg_FROM})
  else()
    target_precompile_headers(${target} PRIVATE ${arg_UNPARSED_ARGUMENTS})
  endif()
  # GCC 12 takes what it precompiled for no system header, and then warns of endless copies in const char* + std::string
  # (its PR 105651).
  target_compile_options(${target} PRIVATE
                         "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>")
endfunction()

# beaconless_module(name [PUBLIC libs…] [PRIVATE libs…] [EXCLUDE files…])
# The library of the folder beaconless/<name>: all its .cpp files.
function(beaconless_module name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE;EXCLUDE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp")
  foreach(file IN LISTS arg_EXCLUDE)
    list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${name}/${file}")
  endforeach()
  set(target beaconless_${name})
  if(sources)
    set(scope PUBLIC)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:beaconless_build_flags> ${arg_PRIVATE})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    if(name STREQUAL core)
      beaconless_precompile(${target} <algorithm> <cmath> <functional> <optional> <span> <string> <variant> <vector>
                            <Eigen/Core> <Eigen/Geometry>)
    else()
      beaconless_precompile(${target} FROM beaconless_core)
    endif()
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${arg_PUBLIC})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(beaconless::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY BEACONLESS_TARGETS ${target})
endfunction()
