# Packages of the program for systems without VTK and Embree: a relocatable archive and a Debian package, by CPack. They
# contain all libraries but those of every Linux system with GCC's run time, and OpenGL, which `--engine raster` loads.
# The libraries of Penumbra are installed anyway; they name Embree here.
foreach (module IN LISTS penumbra_modules)
  _vtk_module_real_target(penumbra_target ${module})
  install(TARGETS ${penumbra_target} RUNTIME_DEPENDENCY_SET penumbra_libraries
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dependencies EXCLUDE_FROM_ALL)
endforeach ()
install(RUNTIME_DEPENDENCY_SET penumbra_libraries
  PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|pthread|rt|stdc\\+\\+|gcc_s)\\.so" "^libvtkPenumbra"
  DIRECTORIES "$<TARGET_FILE_DIR:VTK::vtksys>"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime)

set(penumbra_licenses "${CMAKE_INSTALL_DATADIR}/doc/penumbra")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${penumbra_licenses}" RENAME copyright COMPONENT runtime)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/Python/Licenses/" DESTINATION "${penumbra_licenses}/licenses" COMPONENT runtime)
file(GLOB penumbra_vtk_licenses "${VTK_DIR}/../content/vtk-*.data/share/licenses/VTK" "${VTK_PREFIX_PATH}/share/licenses/VTK")
install(DIRECTORY ${penumbra_vtk_licenses} DESTINATION "${penumbra_licenses}/licenses" COMPONENT runtime)
foreach (package IN ITEMS libembree3-3 libembree4-4 libtbb12 libgomp1)
  if (EXISTS "/usr/share/doc/${package}/copyright")
    install(FILES "/usr/share/doc/${package}/copyright"
      DESTINATION "${penumbra_licenses}/licenses" RENAME "${package}.txt" COMPONENT runtime)
  endif ()
endforeach ()

string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" penumbra_system)
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_COMPONENTS_ALL runtime)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_NAME penumbra)
set(CPACK_PACKAGE_VENDOR "The Penumbra developers")
set(CPACK_PACKAGE_CONTACT "The Penumbra developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Renders meshes with exact silhouettes, ambient occlusion and indirect light")
set(CPACK_PACKAGE_FILE_NAME "penumbra-${PROJECT_VERSION}-${penumbra_system}")
# The archive has a folder with its name, the Debian package does not.
file(WRITE "${PROJECT_BINARY_DIR}/PackageLayout.cmake"
  "if (CPACK_GENERATOR STREQUAL TGZ)\n  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)\nendif ()\n")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_BINARY_DIR}/PackageLayout.cmake")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/build/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# The versions that the symbols of all files need; Testing/Package/test-package compares them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6 (>= 2.35), libgcc-s1, libstdc++6 (>= 12)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6 | libegl1")
include(CPack)
