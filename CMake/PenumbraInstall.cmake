# Installs the package files for find_package(Penumbra COMPONENTS ...).
include(CMakePackageConfigHelpers)

# The components, and for each one the other components and the modules of VTK that its library links.
set(penumbra_package_components "")
set(penumbra_package_dependencies "")
foreach (module IN LISTS penumbra_modules)
  string(REPLACE "Penumbra::" "" component "${module}")
  list(APPEND penumbra_package_components "${component}")
  _vtk_module_real_target(penumbra_target ${module})
  set(penumbra_needed "")
  foreach (kind IN ITEMS depends private_depends)
    get_property(needed TARGET ${penumbra_target} PROPERTY "INTERFACE_vtk_module_${kind}")
    list(APPEND penumbra_needed ${needed})
  endforeach ()
  list(REMOVE_DUPLICATES penumbra_needed)
  list(SORT penumbra_needed)
  foreach (package IN ITEMS Penumbra VTK)
    set(of_package "${penumbra_needed}")
    list(FILTER of_package INCLUDE REGEX "^${package}::")
    list(TRANSFORM of_package REPLACE "^${package}::" "")
    list(JOIN of_package " " of_package)
    string(APPEND penumbra_package_dependencies
      "set(Penumbra_${component}_NEEDS_${package} ${of_package})\n")
  endforeach ()
endforeach ()
list(SORT penumbra_package_components)
set(penumbra_package_vtk_hints "")
if (PENUMBRA_INSTALL_VTK_PATH)
  set(penumbra_package_vtk_hints "\n  HINTS \"${VTK_DIR}\"")
endif ()
# The generator expression COMPILE_ONLY, as in VTK 9.7 for X11, needs CMake 3.27.
set(penumbra_package_vtk_cmake "")
get_directory_property(penumbra_imported IMPORTED_TARGETS)
foreach (target IN LISTS penumbra_imported)
  get_target_property(penumbra_linked ${target} INTERFACE_LINK_LIBRARIES)
  if (target MATCHES "^VTK::" AND penumbra_linked MATCHES "COMPILE_ONLY")
    set(penumbra_package_vtk_cmake 3.27)
  endif ()
endforeach ()

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
