# Installs the package files for find_package(Penumbra COMPONENTS ...).
include(CMakePackageConfigHelpers)

# The components, and the modules of VTK that their libraries link.
set(penumbra_package_components "")
set(penumbra_package_vtk_components "")
foreach (module IN LISTS penumbra_modules)
  string(REPLACE "Penumbra::" "" component "${module}")
  list(APPEND penumbra_package_components "${component}")
  _vtk_module_real_target(penumbra_target ${module})
  foreach (kind IN ITEMS depends private_depends)
    get_property(needed TARGET ${penumbra_target} PROPERTY "INTERFACE_vtk_module_${kind}")
    list(FILTER needed INCLUDE REGEX "^VTK::")
    list(APPEND penumbra_package_vtk_components ${needed})
  endforeach ()
endforeach ()
list(SORT penumbra_package_components)
list(JOIN penumbra_package_components ", " penumbra_package_components)
list(REMOVE_DUPLICATES penumbra_package_vtk_components)
list(SORT penumbra_package_vtk_components)
list(TRANSFORM penumbra_package_vtk_components REPLACE "^VTK::" "")
list(JOIN penumbra_package_vtk_components " " penumbra_package_vtk_components)
set(penumbra_package_vtk_hints "")
if (PENUMBRA_INSTALL_VTK_PATH)
  set(penumbra_package_vtk_hints "\n  HINTS \"${VTK_DIR}\"")
endif ()

set(penumbra_config_destination "${CMAKE_INSTALL_LIBDIR}/cmake/penumbra")
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/CMake/PenumbraConfig.cmake.in" "${PROJECT_BINARY_DIR}/PenumbraConfig.cmake"
  INSTALL_DESTINATION "${penumbra_config_destination}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/PenumbraConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${PROJECT_BINARY_DIR}/PenumbraConfig.cmake"
    "${PROJECT_BINARY_DIR}/PenumbraConfigVersion.cmake"
  DESTINATION "${penumbra_config_destination}")

# The version for preprocessors, as in vtkVersionMacros.h.
configure_file(
  "${PROJECT_SOURCE_DIR}/CMake/vtkPenumbraVersionMacros.h.in" "${PROJECT_BINARY_DIR}/vtkPenumbraVersionMacros.h" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/vtkPenumbraVersionMacros.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/penumbra")
