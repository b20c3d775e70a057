# Build options, and settings of all targets.
include(GNUInstallDirs)
include(CTest)

option(PENUMBRA_BUILD_COMMAND "Build the program `penumbra`." ON)
option(PENUMBRA_BUILD_BENCHMARKS "Build the benchmarks in addition to the tests." ON)
option(PENUMBRA_BUILD_PLUGIN "Build the plugin for ParaView; requires the VTK of ParaView." OFF)
option(PENUMBRA_BUILD_PYTHON "Build the Python modules, for CPython 3.12 and newer." OFF)
option(PENUMBRA_BUILD_PACKAGE "Let CPack package the program with all its libraries." OFF)
set(PENUMBRA_PYTHON_VTK cvista CACHE STRING
  "Python package whose VTK the modules use: cvista (stable ABI) or vtkmodules (one CPython, old C++ ABI).")
option(PENUMBRA_WARNINGS_AS_ERRORS "Fail on compiler warnings." OFF)
option(PENUMBRA_TEST_ONCE
  "Run the tests labelled `once`, too: no option of the compiler and no version of VTK changes their results." ON)
option(PENUMBRA_TEST_OWN
  "Run the tests of our own algorithms, too, which use only what all versions of VTK compute alike." ON)
option(PENUMBRA_SANITIZERS "Build with AddressSanitizer and UBSan." OFF)
option(PENUMBRA_INSTALL_VTK_PATH
  "Store the folder of VTK in the installed package and libraries. OFF: for another machine." ON)
set(PENUMBRA_WINDOW vtkOSOpenGLRenderWindow CACHE STRING
  "Class of vtkRenderWindow that the tests use.")

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif ()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if (DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
  message(FATAL_ERROR "Penumbra is built as shared libraries only, because its classes replace classes of "
    "VTK at run time and VTK's Python modules load them. Remove BUILD_SHARED_LIBS=OFF.")
endif ()
set(BUILD_SHARED_LIBS ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH "${PENUMBRA_INSTALL_VTK_PATH}")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Programs are not linked again if only the code of a library has changed.
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)

# In a package, libraries without a path of their own, such as Embree's, find others by that of the program.
if (PENUMBRA_BUILD_PACKAGE)
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  add_link_options(-Wl,--disable-new-dtags)
endif ()

# In a wheel, libraries find each other and VTK relative to their own folder.
if (PENUMBRA_BUILD_PYTHON)
  set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH OFF)
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../../${PENUMBRA_PYTHON_VTK}")
  add_link_options(-Wl,--disable-new-dtags)
  if (PENUMBRA_PYTHON_VTK STREQUAL vtkmodules)
    set(CVISTA_ABI3 OFF)
    add_compile_definitions(_GLIBCXX_USE_CXX11_ABI=0)
  endif ()
endif ()

# Disable fused multiply-add, so that images do not depend on the compiler.
add_compile_options(-ffp-contract=off)

# GCC reports checks inserted by AddressSanitizer as uses of uninitialized variables.
if (PENUMBRA_SANITIZERS)
  add_compile_options(-O2 -g1 -UNDEBUG -fno-omit-frame-pointer -Wno-maybe-uninitialized
    -fsanitize=address,undefined -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif ()

find_program(PENUMBRA_CCACHE ccache)
if (PENUMBRA_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER "${PENUMBRA_CCACHE}")
  # Without CCACHE_SLOPPINESS, ccache does not cache sources with precompiled headers; without CCACHE_INODECACHE, it reads
  # the 160 MB of the precompiled header for each of them.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_INODECACHE=1 "${PENUMBRA_CCACHE}")
endif ()

# penumbra_precompile(<target> [header...]) precompiles headers of VTK and the standard library, and others, which are half
# of the time of a source that includes vtkRenderer.h. Only for targets with many sources: it takes ten seconds itself.
function (penumbra_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <string> <utility> <vector>
    <vtkActor.h> <vtkCamera.h> <vtkCellArray.h> <vtkCellData.h> <vtkDoubleArray.h> <vtkFloatArray.h> <vtkImageData.h>
    <vtkMapper.h> <vtkMath.h> <vtkMatrix4x4.h> <vtkNew.h> <vtkObjectFactory.h> <vtkPointData.h> <vtkPoints.h>
    <vtkPolyData.h> <vtkProperty.h> <vtkRenderer.h> <vtkSmartPointer.h> <vtkUnsignedCharArray.h>
    ${ARGN})
endfunction ()

# Refers to the generated headers of VTK's modules by their names instead of their paths, so that all clones share the
# entries of ccache.
function (penumbra_relative_definitions target)
  get_target_property(definitions ${target} COMPILE_DEFINITIONS)
  if (definitions MATCHES "_AUTOINIT_INCLUDE=")
    string(REPLACE "${CMAKE_BINARY_DIR}/CMakeFiles/vtkModuleAutoInit" "vtkModuleAutoInit" definitions "${definitions}")
    set_target_properties(${target} PROPERTIES COMPILE_DEFINITIONS "${definitions}")
    target_include_directories(${target} PRIVATE "${CMAKE_BINARY_DIR}/CMakeFiles")
  endif ()
endfunction ()

# penumbra_warnings(<target>) enables the compiler warnings of the project.
function (penumbra_warnings target)
  penumbra_relative_definitions(${target})
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
    $<$<BOOL:${PENUMBRA_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction ()
