# cmake -DPACKAGE=FOLDER -P find-with-old-cmake.cmake: a package whose VTK needs a newer CMake for windows says so before it
# searches VTK.
cmake_minimum_required(VERSION 3.22)
set(CMAKE_VERSION 3.25.1)
find_package(Penumbra QUIET CONFIG COMPONENTS RenderingIrradiance PATHS "${PACKAGE}" NO_DEFAULT_PATH)
if (Penumbra_FOUND OR NOT Penumbra_NOT_FOUND_MESSAGE STREQUAL "The VTK of this package needs CMake 3.27.")
  message(FATAL_ERROR "Penumbra_FOUND: ${Penumbra_FOUND}, message: '${Penumbra_NOT_FOUND_MESSAGE}'")
endif ()
