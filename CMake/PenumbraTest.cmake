# penumbra_test(<TestName> [SOURCES more.cxx...] [LABELS label...] MODULES Penumbra::... VTK::...)
# One GoogleTest executable from <TestName>.cxx; each TEST becomes a CTest test.
include(GoogleTest)

# The semicolons are escaped because gtest_discover_tests() treats them as argument separators.
# intercept_tls_get_addr: GCC 12's sanitizers mistake thread-local blocks at a certain page offset for those
# of an older glibc, and the leak check crashes (fixed in GCC 14).
string(JOIN "\\;" penumbra_test_environment
  "VTK_DEFAULT_OPENGL_WINDOW=${PENUMBRA_WINDOW}"
  "ASAN_OPTIONS=intercept_tls_get_addr=0"
  "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/Testing/leaks.supp:print_suppressions=0"
  "UBSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/Testing/undefined.supp:print_stacktrace=1")

# Ends a test after this time with its stack printed; reports processes that it leaves behind.
if (BUILD_TESTING)
  add_executable(penumbra-run-limited "${PROJECT_SOURCE_DIR}/Testing/Launcher/run-limited.cxx")
  penumbra_warnings(penumbra-run-limited)
endif ()
set(penumbra_test_launcher "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/penumbra-run-limited" --limit 570)

function (penumbra_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LABELS;MODULES")
  add_executable(${name} ${name}.cxx ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_MODULES} GTest::gtest GTest::gtest_main)
  vtk_module_autoinit(TARGETS ${name} MODULES ${arg_MODULES})
  penumbra_warnings(${name})
  set_target_properties(${name} PROPERTIES CROSSCOMPILING_EMULATOR "${penumbra_test_launcher}")
  add_dependencies(${name} penumbra-run-limited)
  if (NOT arg_LABELS)
    set(arg_LABELS fast)
  endif ()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 300
    PROPERTIES
      LABELS "${arg_LABELS}"
      ENVIRONMENT "${penumbra_test_environment}")
endfunction ()
