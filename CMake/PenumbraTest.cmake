# penumbra_test(<TestName> [OWN] [SOURCES more.cxx...] [LABELS label...] MODULES Penumbra::... VTK::...)
# GoogleTest cases in <TestName>.cxx and the other sources, which are one CTest test. The target <TestName> holds the objects. The
# tests of a folder with the same labels are one program, <Folder>Tests: it links in seconds, where one for each source
# takes minutes. `ninja <Folder>Tests` builds it. Tests with the label `once` are part of it only if PENUMBRA_TEST_ONCE
# is ON; tests with OWN only if PENUMBRA_TEST_OWN is ON. The cases in Testing/once.txt are a CTest test of their own,
# <TestName>.once with the label `once`, only if PENUMBRA_TEST_ONCE is ON.

# intercept_tls_get_addr: GCC 12's sanitizers mistake thread-local blocks at a certain page offset for those
# of an older glibc, and the leak check crashes (fixed in GCC 14).
# LP_NUM_THREADS: threads of llvmpipe take an eighth more processor time with the sanitizers.
set(penumbra_test_environment
  "VTK_DEFAULT_OPENGL_WINDOW=${PENUMBRA_WINDOW}"
  "LP_NUM_THREADS=0"
  "ASAN_OPTIONS=intercept_tls_get_addr=0"
  "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/Testing/leaks.supp:print_suppressions=0"
  "UBSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/Testing/undefined.supp:print_stacktrace=1")

# Sets <output> to the cases in Testing/once.txt that <sources> hold, as patterns of GoogleTest.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Testing/once.txt")
file(STRINGS "${PROJECT_SOURCE_DIR}/Testing/once.txt" penumbra_once_cases REGEX "^[A-Za-z]")
function (penumbra_once_patterns output)
  set(text "")
  foreach (source IN LISTS ARGN)
    file(READ ${source} part)
    string(APPEND text "${part}")
  endforeach ()
  set(patterns "")
  foreach (case IN LISTS penumbra_once_cases)
    string(REGEX REPLACE "^([^.]+)[.]([^/]+).*$" "(\\1, \\2)" head "${case}")
    string(FIND "${text}" "${head}" position)
    if (NOT position EQUAL -1)
      string(APPEND patterns "${case}:*/${case}:*/${case}/*:")
    endif ()
  endforeach ()
  set(${output} "${patterns}" PARENT_SCOPE)
endfunction ()

# The launcher ends a test after this time with its stack printed, and reports processes that it leaves behind.
if (BUILD_TESTING)
  add_executable(penumbra-run-limited "${PROJECT_SOURCE_DIR}/Testing/Launcher/run-limited.cxx")
  penumbra_warnings(penumbra-run-limited)
  add_library(penumbra_test_main OBJECT "${PROJECT_SOURCE_DIR}/Testing/Launcher/main.cxx")
  target_include_directories(penumbra_test_main PRIVATE "${PROJECT_SOURCE_DIR}/Command")
  target_link_libraries(penumbra_test_main PUBLIC GTest::gtest)
  penumbra_warnings(penumbra_test_main)
endif ()
set(penumbra_test_launcher "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/penumbra-run-limited" --limit 570)

# Sets <output> to the program of the tests of the current folder with these labels.
function (penumbra_test_program output labels)
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  string(REGEX REPLACE "^(Testing|Benchmarks)/|/Testing$" "" folder "${folder}")
  string(REPLACE "/" "" program "${folder}")
  if (program STREQUAL "Testing")
    set(program Project)
  endif ()
  if (NOT labels STREQUAL "fast")
    string(REPLACE ";" "" suffix "${labels}")
    string(APPEND program "-${suffix}")
  endif ()
  set(${output} "${program}Tests" PARENT_SCOPE)
endfunction ()

function (penumbra_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN" "" "SOURCES;LABELS;MODULES")
  if (NOT arg_LABELS)
    set(arg_LABELS fast)
  endif ()
  if (("once" IN_LIST arg_LABELS AND NOT PENUMBRA_TEST_ONCE) OR (arg_OWN AND NOT PENUMBRA_TEST_OWN))
    add_library(${name} OBJECT EXCLUDE_FROM_ALL ${name}.cxx ${arg_SOURCES})
    return()
  endif ()
  penumbra_test_program(program "${arg_LABELS}")
  if (NOT TARGET ${program})
    add_executable(${program})
    set_target_properties(${program} PROPERTIES LINKER_LANGUAGE CXX)
    target_link_libraries(${program} PRIVATE penumbra_test_main)
    add_dependencies(${program} penumbra-run-limited)
  endif ()

  # Sources that several tests name are compiled with the first of them.
  get_property(compiled TARGET ${program} PROPERTY PENUMBRA_SOURCES)
  list(REMOVE_ITEM arg_SOURCES ${compiled})
  set_property(TARGET ${program} APPEND PROPERTY PENUMBRA_SOURCES ${arg_SOURCES})

  add_library(${name} OBJECT ${name}.cxx ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_MODULES} GTest::gtest)
  vtk_module_autoinit(TARGETS ${name} MODULES ${arg_MODULES})
  penumbra_warnings(${name})
  # Takes half the time of -O3 to compile; the time of tests is spent in the modules and references.
  target_compile_options(${name} PRIVATE -O1)
  target_link_libraries(${program} PRIVATE ${name})

  list(TRANSFORM arg_SOURCES REPLACE "^.*/|[.]cxx$" "" OUTPUT_VARIABLE sources)
  add_test(NAME ${name} COMMAND ${penumbra_test_launcher} $<TARGET_FILE:${program}> ${name} ${sources})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77 LABELS "${arg_LABELS}" ENVIRONMENT "${penumbra_test_environment}")

  penumbra_once_patterns(patterns ${name}.cxx ${arg_SOURCES})
  if (patterns)
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "GTEST_FILTER=-${patterns}")
    if (PENUMBRA_TEST_ONCE)
      add_test(NAME ${name}.once COMMAND ${penumbra_test_launcher} $<TARGET_FILE:${program}>)
      set_tests_properties(${name}.once PROPERTIES SKIP_RETURN_CODE 77 LABELS once
        ENVIRONMENT "${penumbra_test_environment};GTEST_FILTER=${patterns}")
    endif ()
  endif ()
endfunction ()
