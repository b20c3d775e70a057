# The modules of the table in Documentation/dev/Architecture.md, built with VTK's module system.
include(PenumbraTest)

set(penumbra_module_files
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Comparison/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Irradiance/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Medium/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Parallel/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/RayCasting/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/RayTracing/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Scene/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/Irradiance/vtk.module"
  "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/ScreenSpace/vtk.module")

# Support for regression tests of other projects.
if (BUILD_TESTING)
  list(APPEND penumbra_module_files
    "${CMAKE_CURRENT_SOURCE_DIR}/Testing/Comparison/vtk.module")
endif ()
if (PENUMBRA_BUILD_PLUGIN)
  list(APPEND penumbra_module_files
    "${CMAKE_CURRENT_SOURCE_DIR}/Rendering/ParaView/vtk.module")
endif ()

vtk_module_scan(
  MODULE_FILES ${penumbra_module_files}
  PROVIDES_MODULES penumbra_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS "${BUILD_TESTING}")

vtk_module_build(
  MODULES ${penumbra_modules}
  PACKAGE Penumbra
  INSTALL_EXPORT Penumbra
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/penumbra"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra"
  VERSION "${PROJECT_VERSION}"
  SOVERSION 0
  TEST_DIRECTORY_NAME Testing)

set(penumbra_python_modules ${penumbra_modules})
list(REMOVE_ITEM penumbra_python_modules Penumbra::FiltersParallel Penumbra::TestingComparison)
foreach (module IN LISTS penumbra_modules)
  _vtk_module_real_target(penumbra_target ${module})
  penumbra_warnings(${penumbra_target})
  # Filters/Statistics: a header that filters and passes share.
  target_include_directories(${penumbra_target} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/Filters")
  if (module MATCHES "Filters(Irradiance|RayCasting|RayTracing|Scene)|RenderingIrradiance")
    penumbra_precompile(${penumbra_target} <glm/glm.hpp>)
  elseif (module MATCHES "RenderingScreenSpace")
    penumbra_precompile(${penumbra_target} <vtkOpenGLRenderWindow.h> <vtkOpenGLState.h> <vtkShaderProgram.h>)
  endif ()
endforeach ()
