# Installs the package files for find_package(Penumbra COMPONENTS ...).
include(CMakePackageConfigHelpers)

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
